/* saved_planes.c - the fields of a sheet that a saved state and a checkpoint hold, to the bit:
 * a row each. */
#include "history.h" /* what a plane is */
#include "model/model.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Where the field of a plane is: beside the others, or one for each pigment; and what numbers
 * there can be in it. */
struct place {
    size_t member;
    int pigment;
    float least, most;
    bool amount; /* in whole grains, of papers with parts */
};

/* More of water or a pigment than any fiber gets; sums up to it are exact. */
#define AMOUNT_MOST 0x1p24f

static void plane_add(struct paper_plane *planes, struct place *places, int *count,
                      const char *name, struct place place)
{
    assert(*count < PAPER_PLANES_MAX);
    struct paper_plane *plane = &planes[*count];
    int pigment = place.pigment;
    places[(*count)++] = place;
    *plane = (struct paper_plane){.since = 1};
    if (pigment >= 0)
        snprintf(plane->name, sizeof plane->name, "%s %d", name, pigment + 1);
    else
        snprintf(plane->name, sizeof plane->name, "%s", name);
}

/* Their order is that of files: it changes with the model's version only (PAPER_MODEL_VERSION
 * in sheet.h). A new field is a member in model.h, made in fields.c, cleared in
 * sheet_reset(). */
static int planes_make(const struct paper_sheet_config *config, struct paper_plane *planes,
                       struct place *places)
{
    static const char *const channels[3] = {"red", "green", "blue"};
    int count = 0;
    unsigned parts = config->parts;
#define PLANE(name, member, least, most)                                                       \
    plane_add(planes, places, &count, name,                                                    \
              (struct place){offsetof(struct paper_sheet, member), -1, least, most, false})
#define AMOUNT(name, member, pigment)                                                          \
    plane_add(                                                                                 \
        planes, places, &count, name,                                                          \
        (struct place){offsetof(struct paper_sheet, member), pigment, 0, AMOUNT_MOST, true})
    PLANE("height", height, 0, 1);
    PLANE("absorbency", page.absorbency, 0, (float)PAPER_ABSORBENCY_MAX);
    PLANE("capacity", capacity, 0.01f, 1);
    PLANE("resist", resist, 0, 1);
    PLANE("varnish", varnish, 0, 1);
    PLANE("salt", salt, 0, 4);
    PLANE("brine", brine, 0, 4);
    for (int i = 0; i < 3; i++)
        PLANE(channels[i], substrate[i], 0, AMOUNT_MOST);
    AMOUNT("infused water", page.water, -1);
    AMOUNT("surface water", surface_water, -1);
    PLANE("wet around", wet_around, 0, 1);
    PLANE("dried water", dried, 0, 0);
    planes[count - 1].whole = true;
    if (parts & (PAPER_PART_SURFACE | PAPER_PART_EDGE)) {
        PLANE("sizing", sizing, 0.01f, 100); /* as layers.c lets it be */
        PLANE("current", current, -10, 10);
        PLANE("wet part", wet_part, 0, 1);
        PLANE("speed along y", speed[0], -1, 1);
        PLANE("speed along x", speed[1], -1, 1);
    }
    if (parts & (PAPER_PART_SURFACE | PAPER_PART_EDGE)) {
        PLANE("stained part", stained, 0, 1);
        planes[count - 1].since = 2;
    }
    if (parts)
        PLANE("grip", grip, PAPER_GRIP_LEAST, PAPER_GRIP_MOST);
    if (config->deckled)
        PLANE("thickness", thickness, 0, 1);
    for (int i = 0; i < config->pigments_count; i++) {
        if (parts & (PAPER_PART_SURFACE | PAPER_PART_EDGE))
            AMOUNT("surface pigment", surface, i);
        AMOUNT("infused pigment", infused, i);
        if (parts & PAPER_PART_FIXING)
            AMOUNT("fixed pigment", fixed, i);
    }
#undef PLANE
#undef AMOUNT
    return count;
}

int paper_config_planes(const struct paper_sheet_config *config,
                        struct paper_plane planes[PAPER_PLANES_MAX])
{
    struct place places[PAPER_PLANES_MAX];
    return planes_make(config, planes, places);
}

int paper_sheet_planes(const struct paper_sheet *p, struct paper_plane planes[PAPER_PLANES_MAX])
{
    return paper_config_planes(&p->config, planes);
}

static CM_field_id_t plane_field(const struct paper_sheet *p, int number, bool *whole)
{
    struct paper_plane planes[PAPER_PLANES_MAX];
    struct place places[PAPER_PLANES_MAX];
    CM_field_id_t field;
    planes_make(&p->config, planes, places);
    int pigment = places[number].pigment;
    size_t member = places[number].member + (pigment > 0 ? (size_t)pigment * sizeof field : 0);
    memcpy(&field, (const char *)p + member, sizeof field);
    *whole = planes[number].whole;
    return field;
}

enum paper_status sheet_plane_check(const struct paper_sheet *p, int number, const void *words)
{
    struct paper_plane planes[PAPER_PLANES_MAX];
    struct place places[PAPER_PLANES_MAX];
    planes_make(&p->config, planes, places);
    const struct place *place = &places[number];
    size_t count = (size_t)p->page.grid.width * (size_t)p->page.grid.height;
    const uint32_t *whole = words;
    const float *values = words;
    bool good = true, grains = place->amount && p->unit != 1;
    for (size_t i = 0; i < count; i++)
        good &= planes[number].whole ? whole[i] < 1u << SHEET_DRIED_BITS
                                     : values[i] >= place->least && values[i] <= place->most &&
                                           (!grains || (float)(uint32_t)values[i] == values[i]);
    return good ? PAPER_OK
                : paper_fail(PAPER_BAD_FILE, "its plane '%s' holds what no sheet can",
                             planes[number].name);
}

enum paper_status sheet_plane_fetch(struct paper_sheet *p, int number, void *words)
{
    bool whole;
    CM_field_id_t field = plane_field(p, number, &whole);
    sheet_look(p);
    CM_set_context();
    if (whole)
        kit_grid_u_read(&p->page.grid, words, field, SHEET_DRIED_BITS, CM_32_bit);
    else
        kit_grid_f_read(&p->page.grid, words, field);
    return paper_leave(&p->page);
}

void sheet_plane_write(struct paper_sheet *p, int number, const void *words)
{
    bool whole;
    CM_field_id_t field = plane_field(p, number, &whole);
    CM_set_context();
    if (whole)
        kit_grid_u_write(&p->page.grid, field, SHEET_DRIED_BITS, words, CM_32_bit);
    else
        kit_grid_f_write(&p->page.grid, field, words);
}

/* Fibers of the sheet, which lie in rows of their own. */
static struct kit_block block_of(const struct paper_area *a)
{
    return (struct kit_block){a->x, a->y, a->width, a->height, 0, 0, a->width, a->height};
}

enum paper_status sheet_plane_part_fetch(struct paper_sheet *p, int number,
                                         const struct paper_area *area, void *words)
{
    bool whole;
    const CM_field_id_t field = plane_field(p, number, &whole);
    const struct kit_block block = block_of(area);
    sheet_look(p);
    CM_set_context();
    kit_grid_block_read(&block, words, field, whole ? SHEET_DRIED_BITS : 0);
    return paper_leave(&p->page);
}

void sheet_plane_part_write(struct paper_sheet *p, int number, const struct paper_area *area,
                            const void *words)
{
    bool whole;
    const CM_field_id_t field = plane_field(p, number, &whole);
    const struct kit_block block = block_of(area);
    CM_set_context();
    kit_grid_block_write(&block, field, whole ? SHEET_DRIED_BITS : 0, words);
}

bool sheet_plane_is_followed(const struct paper_sheet *p, int number)
{
    static const size_t members[] = {
        offsetof(struct paper_sheet, height),  offsetof(struct paper_sheet, page.absorbency),
        offsetof(struct paper_sheet, resist),  offsetof(struct paper_sheet, sizing),
        offsetof(struct paper_sheet, current), offsetof(struct paper_sheet, thickness)};
    struct paper_plane planes[PAPER_PLANES_MAX];
    struct place places[PAPER_PLANES_MAX];
    planes_make(&p->config, planes, places);
    bool is = false;
    for (size_t i = 0; i < sizeof members / sizeof *members; i++)
        is |= places[number].member == members[i];
    return is;
}

void sheet_planes_written(struct paper_sheet *p)
{
    CM_set_context();
    sheet_faces_make(p);
    sheet_heights_changed(p);
}
