/* description.c - a sheet's description and its air as bytes, and scaled to another
 * resolution. */
#include "arguments/forms.h"
#include "arguments/rows.h"
#include "bands.h"
#include "event/event.h"

#include <stream.h>

#include <string.h>

/* Among the parts: a deckle follows the stock; what is known of pigments by bands follows the
 * pigments, if anything is. */
enum { PARTS_BITS = 16 };
#define DECKLED (UINT64_C(1) << 31)
#define BANDED (UINT64_C(1) << 30)

static void config_pass(struct event_stream *s, struct paper_sheet_config *config)
{
    uint64_t width = event_pass_number(s, (uint64_t)config->width, 4),
             height = event_pass_number(s, (uint64_t)config->height, 4),
             torus = event_pass_number(s, config->torus, 1),
             parts = event_pass_number(s,
                                       config->parts | (config->deckled ? DECKLED : 0) |
                                           (paper_config_banded(config) ? BANDED : 0),
                                       4),
             rule = event_pass_number(s, (uint64_t)config->rule, 4),
             seed = event_pass_number(s, config->seed, 8),
             pigments = event_pass_number(s, (uint64_t)config->pigments_count, 4);
    event_stream_expect(s, width >= PAPER_SIDE_MIN && width <= PAPER_SIDE_MAX &&
                               height >= PAPER_SIDE_MIN && height <= PAPER_SIDE_MAX &&
                               (parts & ~(DECKLED | BANDED)) >> PARTS_BITS == 0 &&
                               rule <= PAPER_RULE_LUMINOUS && pigments <= PAPER_PIGMENTS_MAX);
    if (!event_stream_good(s))
        return;
    if (s->in)
        *config =
            (struct paper_sheet_config){.width = (int)width,
                                        .height = (int)height,
                                        .torus = torus != 0,
                                        .parts = (unsigned)parts & ((1u << PARTS_BITS) - 1),
                                        .rule = (enum paper_rule)rule,
                                        .seed = seed,
                                        .pigments_count = (int)pigments,
                                        .deckled = (parts & DECKLED) != 0};
    event_pass_members(s, &paper_stock_members, &config->stock);
    if (config->deckled)
        event_pass_members(s, &paper_deckle_members, &config->deckle);
    for (int i = 0; i < config->pigments_count; i++)
        event_pass_members(s, &paper_pigment_members, &config->pigments[i]);
    for (int i = 0; i < config->pigments_count && (parts & BANDED); i++)
        event_pass_members(s, &paper_bands_members, &config->pigments[i]);
}

void sheet_config_encode(struct event_bytes *b, const struct paper_sheet_config *config)
{
    config_pass(&(struct event_stream){.out = b}, members_owned(config));
}

enum paper_status sheet_config_decode(struct event_reader *r, struct paper_sheet_config *config)
{
    *config = (struct paper_sheet_config){0};
    config_pass(&(struct event_stream){.in = r}, config);
    return r->bad ? paper_fail(PAPER_BAD_FILE, "the description of the sheet is damaged")
                  : PAPER_OK;
}

void sheet_config_scale(struct paper_sheet_config *config, const struct event_scaling *scaling)
{
    const struct paper_sizes *sizes = scaling->context;
    config->width = sizes->new_width;
    config->height = sizes->new_height;
    members_scale(&paper_stock_members, &config->stock, scaling);
    if (config->deckled)
        members_scale(&paper_deckle_members, &config->deckle, scaling);
}

void sheet_air_encode(struct event_bytes *b, const struct paper_air *air)
{
    event_pass_members(&(struct event_stream){.out = b}, &paper_air_members,
                       members_owned(air));
}

void sheet_air_decode(struct event_reader *r, struct paper_air *air)
{
    memset(air, 0, sizeof *air);
    event_pass_members(&(struct event_stream){.in = r}, &paper_air_members, air);
}
