/* bytes.c - operations and sheets as bytes.
 *
 * The members in the order of their rows; numbers with their low byte first, doubles as IEEE's 64 bits, whole numbers 8
 * bytes with two's complement, flags and text as they are, a screen as x, y, width, height (4 bytes each) and its gray.
 *
 * What is put and what is gotten is said once: each ..._pass() below does either, as its stream is. */
#include "arguments/members.h"
#include "event/event.h"
#include "model/model.h"

#include <stdlib.h>
#include <string.h>

/* ---- single numbers ---- */

void event_put_bytes(struct event_bytes *b, const void *bytes, size_t count)
{
    if (b->short_of_memory || count == 0)
        return;
    if (count > b->room - b->count) {
        size_t room = b->room ? b->room : 256;
        while (room - b->count < count)
            room *= 2;
        uint8_t *grown = realloc(b->at, room);
        if (!grown) {
            b->short_of_memory = true;
            return;
        }
        b->at = grown;
        b->room = room;
    }
    memcpy(b->at + b->count, bytes, count);
    b->count += count;
}

void event_put_number(struct event_bytes *b, uint64_t number, int bytes)
{
    uint8_t low_first[8];
    for (int i = 0; i < bytes; i++)
        low_first[i] = (uint8_t)(number >> 8 * i);
    event_put_bytes(b, low_first, (size_t)bytes);
}

void event_put_double(struct event_bytes *b, double number)
{
    uint64_t bits;
    memcpy(&bits, &number, sizeof bits);
    event_put_number(b, bits, 8);
}

const uint8_t *event_get_bytes(struct event_reader *r, size_t count)
{
    if (r->bad || count > (size_t)(r->end - r->at)) {
        r->bad = true;
        return NULL;
    }
    const uint8_t *bytes = r->at;
    r->at += count;
    return bytes;
}

uint64_t event_get_number(struct event_reader *r, int bytes)
{
    const uint8_t *low_first = event_get_bytes(r, (size_t)bytes);
    uint64_t number = 0;
    for (int i = 0; low_first && i < bytes; i++)
        number |= (uint64_t)low_first[i] << 8 * i;
    return number;
}

double event_get_double(struct event_reader *r)
{
    uint64_t bits = event_get_number(r, 8);
    double number;
    memcpy(&number, &bits, sizeof number);
    return number;
}

/* ---- one way or the other ---- */

/* Bytes that are put, or gotten. While they are put, what is passed is only read. */
struct stream {
    struct event_bytes *out; /* one of these two */
    struct event_reader *in;
    const struct paper_sheet_config *config; /* of the sheet that they are for */
    bool short_of_memory;                    /* for what was gotten */
};

static void members_pass(struct stream *s, const struct members *members, void *of);

/* Returns what was gotten, or the number itself. */
static uint64_t number_pass(struct stream *s, uint64_t number, int bytes)
{
    if (s->in)
        return event_get_number(s->in, bytes);
    event_put_number(s->out, number, bytes);
    return number;
}

static void bad_unless(struct stream *s, bool good)
{
    if (s->in && !good)
        s->in->bad = true;
}

static bool going_on(const struct stream *s)
{
    return !s->in || (!s->in->bad && !s->short_of_memory);
}

static void int_pass(struct stream *s, int *at, int64_t least, int64_t most)
{
    int64_t number = (int64_t)number_pass(s, (uint64_t)(int64_t)*at, 8);
    bad_unless(s, number >= least && number <= most);
    if (s->in)
        *at = s->in->bad ? 0 : (int)number;
}

static void flag_pass(struct stream *s, bool *at)
{
    bool flag = number_pass(s, *at, 1) != 0;
    if (s->in)
        *at = flag;
}

/* Words of 8 bytes, and doubles, which are such words. */
static void words_pass(struct stream *s, void *words, int count)
{
    for (int i = 0; i < count; i++) {
        uint64_t word;
        char *at = (char *)words + (size_t)i * sizeof word;
        memcpy(&word, at, sizeof word);
        word = number_pass(s, word, 8);
        if (s->in)
            memcpy(at, &word, sizeof word);
    }
}

static void text_pass(struct stream *s, char *text, size_t size)
{
    if (!s->in) {
        event_put_bytes(s->out, text, size);
        return;
    }
    const uint8_t *bytes = event_get_bytes(s->in, size);
    bad_unless(s, bytes && memchr(bytes, '\0', size));
    if (!s->in->bad)
        memcpy(text, bytes, size);
}

/* An array, made when it is gotten. Floats are kept as they are: low byte first here and on every machine this runs on. */
_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "low byte first");
static void *array_pass(struct stream *s, const void *array, size_t size)
{
    if (!s->in) {
        event_put_bytes(s->out, array, size);
        return event_owned(array);
    }
    const uint8_t *bytes = event_get_bytes(s->in, size);
    void *made = bytes ? malloc(size) : NULL;
    if (made)
        memcpy(made, bytes, size);
    else if (bytes)
        s->short_of_memory = true;
    return made;
}

/* ---- places ---- */

struct rectangle {
    int64_t x, y, width, height;
};

/* What of a screen lies on the sheet. */
static struct rectangle on_sheet(const struct paper_place *place,
                                 const struct paper_sheet_config *config)
{
    int64_t x1 = place->x > 0 ? place->x : 0, y1 = place->y > 0 ? place->y : 0;
    int64_t x2 = (int64_t)place->x + place->screen->width_px,
            y2 = (int64_t)place->y + place->screen->height_px;
    x2 = x2 < config->width ? x2 : config->width;
    y2 = y2 < config->height ? y2 : config->height;
    if (x1 >= x2 || y1 >= y2)
        return (struct rectangle){0, 0, 0, 0};
    return (struct rectangle){x1, y1, x2 - x1, y2 - y1};
}

/* A screen that has nothing is one dot of 0, so that every place has a screen that can be put. */
static void screen_get(struct stream *s, const struct rectangle *r, struct paper_place *place)
{
    bad_unless(s, r->x <= s->config->width && r->y <= s->config->height &&
                      r->width <= s->config->width - r->x &&
                      r->height <= s->config->height - r->y &&
                      (r->width == 0) == (r->height == 0));
    if (s->in->bad)
        return;
    struct paper_screen *screen = malloc(sizeof *screen);
    uint8_t *gray =
        r->width ? array_pass(s, NULL, (size_t)(r->width * r->height)) : calloc(1, 1);
    if (!screen || !gray) {
        s->short_of_memory = !s->in->bad;
        free(screen);
        free(gray);
        return;
    }
    *screen = (struct paper_screen){.width_px = r->width ? (int)r->width : 1,
                                    .height_px = r->height ? (int)r->height : 1,
                                    .gray = gray};
    *place = (struct paper_place){screen, (int)r->x, (int)r->y};
}

static void place_pass(struct stream *s, struct paper_place *place)
{
    bool everywhere = !place->screen;
    flag_pass(s, &everywhere);
    if (everywhere)
        return;
    struct rectangle r = {0, 0, 0, 0};
    if (!s->in)
        r = on_sheet(place, s->config);
    int64_t *const numbers[4] = {&r.x, &r.y, &r.width, &r.height};
    for (int i = 0; i < 4; i++)
        *numbers[i] = (int64_t)number_pass(s, (uint64_t)*numbers[i], 4);
    if (s->in) {
        screen_get(s, &r, place);
        return;
    }
    const struct paper_screen *screen = place->screen;
    for (int64_t y = r.y; y < r.y + r.height; y++)
        event_put_bytes(s->out,
                        screen->gray + (y - place->y) * (int64_t)screen->width_px +
                            (r.x - place->x),
                        (size_t)r.width);
}

/* ---- arrays of their own ---- */

static void samples_pass(struct stream *s, struct paper_stroke *stroke)
{
    uint64_t count = number_pass(s, (uint64_t)stroke->samples_count, 4);
    struct paper_stroke_sample *samples = event_owned(stroke->samples);
    if (s->in) {
        bad_unless(s, count > 0 && count <= PAPER_STROKE_SAMPLES_MAX &&
                          count * sizeof *samples <= (size_t)(s->in->end - s->in->at));
        samples = s->in->bad ? NULL : calloc((size_t)count, sizeof *samples);
        s->short_of_memory = !samples && !s->in->bad;
        if (!samples)
            return;
        stroke->samples_count = (int)count;
        stroke->samples = samples;
    }
    for (uint64_t i = 0; i < count; i++)
        members_pass(s, &event_sample_members, &samples[i]);
}

/* Its rectangle, and for each substance whether there is an array, and the array. A rectangle that cannot be is put, without
 * arrays, so that it can be refused. */
static void amounts_pass(struct stream *s, struct paper_print *print)
{
    int *const rectangle[4] = {&print->x, &print->y, &print->width, &print->height};
    for (int i = 0; i < 4; i++)
        int_pass(s, rectangle[i], -64 * PAPER_SIDE_MAX, 64 * PAPER_SIDE_MAX);
    bool good = print->width > 0 && print->height > 0 && print->width <= PAPER_SIDE_MAX &&
                print->height <= PAPER_SIDE_MAX;
    bad_unless(s, good);
    for (int i = 0; i <= s->config->pigments_count && going_on(s); i++) {
        bool there = good && print->amount[i];
        flag_pass(s, &there);
        if (!there)
            continue;
        void *amounts = array_pass(
            s, print->amount[i], (size_t)print->width * (size_t)print->height * sizeof(float));
        if (s->in)
            print->amount[i] = amounts;
    }
}

/* ---- members ---- */

static void member_pass(struct stream *s, const struct member *m, void *of)
{
    void *start = (char *)of + m->offset;
    switch (m->kind) {
    case MEMBER_DOUBLE:
    case MEMBER_WORD:
        words_pass(s, start, m->count);
        break;
    case MEMBER_INT:
        for (int i = 0; i < m->count; i++)
            int_pass(s, (int *)start + i, INT32_MIN, INT32_MAX);
        break;
    case MEMBER_FLAG:
        flag_pass(s, start);
        break;
    case MEMBER_TEXT:
        text_pass(s, start, (size_t)m->count);
        break;
    case MEMBER_PLACE:
        place_pass(s, start);
        break;
    case MEMBER_SAMPLES:
        samples_pass(s, of);
        break;
    case MEMBER_AMOUNTS:
        amounts_pass(s, of);
        break;
    case MEMBER_PLANE: {
        const float **values = start;
        void *plane = array_pass(
            s, *values, (size_t)s->config->width * (size_t)s->config->height * sizeof **values);
        if (s->in)
            *values = plane;
        break;
    }
    }
}

static void members_pass(struct stream *s, const struct members *members, void *of)
{
    for (size_t i = 0; i < members->count && going_on(s); i++)
        member_pass(s, &members->first[i], of);
}

/* ---- operations ---- */

void event_encode(struct event_bytes *b, const struct paper_sheet_config *config,
                  enum sheet_event_kind kind, const void *arguments)
{
    struct stream s = {.out = b, .config = config};
    members_pass(&s, event_members(kind), event_owned(arguments));
}

size_t event_size(enum sheet_event_kind kind)
{
    const struct members *members = event_members(kind);
    size_t size = 0;
    for (const struct member *m = members->first; m < members->first + members->count; m++)
        size += (size_t)m->count * (m->kind == MEMBER_FLAG || m->kind == MEMBER_TEXT ? 1 : 8);
    return size;
}

enum paper_status event_decode(const uint8_t *bytes, size_t count,
                               const struct paper_sheet_config *config,
                               enum sheet_event_kind kind, void **arguments)
{
    struct event_reader r = {bytes, bytes + count, false};
    struct stream s = {.in = &r, .config = config};
    const struct members *members = event_members(kind);
    void *made = NULL;
    *arguments = NULL;
    if (members->count > 0) {
        made = event_blank(kind);
        s.short_of_memory = !made;
        members_pass(&s, members, made);
    }
    if (s.short_of_memory || r.bad || r.at != r.end) {
        event_free(kind, made);
        return s.short_of_memory
                   ? paper_fail(PAPER_NO_MEMORY, "no memory for an event (%s)",
                                event_name(kind))
                   : paper_fail(PAPER_BAD_FILE, "an event (%s) is damaged", event_name(kind));
    }
    *arguments = made;
    return PAPER_OK;
}

/* ---- sheets ---- */

static void config_pass(struct stream *s, struct paper_sheet_config *config)
{
    uint64_t width = number_pass(s, (uint64_t)config->width, 4),
             height = number_pass(s, (uint64_t)config->height, 4),
             torus = number_pass(s, config->torus, 1), parts = number_pass(s, config->parts, 4),
             rule = number_pass(s, (uint64_t)config->rule, 4),
             seed = number_pass(s, config->seed, 8),
             pigments = number_pass(s, (uint64_t)config->pigments_count, 4);
    bad_unless(s, width >= PAPER_SIDE_MIN && width <= PAPER_SIDE_MAX &&
                      height >= PAPER_SIDE_MIN && height <= PAPER_SIDE_MAX &&
                      rule <= PAPER_RULE_LUMINOUS && pigments <= PAPER_PIGMENTS_MAX);
    if (!going_on(s))
        return;
    if (s->in)
        *config = (struct paper_sheet_config){.width = (int)width,
                                              .height = (int)height,
                                              .torus = torus != 0,
                                              .parts = (unsigned)parts,
                                              .rule = (enum paper_rule)rule,
                                              .seed = seed,
                                              .pigments_count = (int)pigments};
    members_pass(s, &event_stock_members, &config->stock);
    for (int i = 0; i < config->pigments_count; i++)
        members_pass(s, &event_pigment_members, &config->pigments[i]);
}

void event_config_encode(struct event_bytes *b, const struct paper_sheet_config *config)
{
    config_pass(&(struct stream){.out = b}, event_owned(config));
}

enum paper_status event_config_decode(struct event_reader *r, struct paper_sheet_config *config)
{
    memset(config, 0, sizeof *config);
    config_pass(&(struct stream){.in = r}, config);
    return r->bad ? paper_fail(PAPER_BAD_FILE, "the description of the sheet is damaged")
                  : PAPER_OK;
}

void event_air_encode(struct event_bytes *b, const struct paper_air *air)
{
    members_pass(&(struct stream){.out = b}, &event_air_members, event_owned(air));
}

void event_air_decode(struct event_reader *r, struct paper_air *air)
{
    memset(air, 0, sizeof *air);
    members_pass(&(struct stream){.in = r}, &event_air_members, air);
}
