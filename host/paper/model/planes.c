/* planes.c - all that changes in a sheet, in and out, to the bit. */
#include "history.h" /* what a plane is */
#include "model/model.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Where the field of a plane is: beside the others, or one for each pigment. */
struct place {
    size_t member;
    int pigment;
};

static void plane_add(struct paper_plane *planes, struct place *places, int *count,
                      const char *name, size_t member, int pigment)
{
    struct paper_plane *plane = &planes[*count];
    places[(*count)++] = (struct place){member, pigment};
    *plane = (struct paper_plane){0};
    if (pigment >= 0)
        snprintf(plane->name, sizeof plane->name, "%s %d", name, pigment + 1);
    else
        snprintf(plane->name, sizeof plane->name, "%s", name);
}

/* Their order is that of files: it changes with the model's version only. */
static int planes_make(const struct paper_sheet_config *config, struct paper_plane *planes,
                       struct place *places)
{
    static const char *const channels[3] = {"red", "green", "blue"};
    int count = 0;
    unsigned parts = config->parts;
#define AT(member) offsetof(struct paper_sheet, member)
    plane_add(planes, places, &count, "height", AT(height), -1);
    plane_add(planes, places, &count, "absorbency", AT(page.absorbency), -1);
    plane_add(planes, places, &count, "capacity", AT(capacity), -1);
    plane_add(planes, places, &count, "resist", AT(resist), -1);
    plane_add(planes, places, &count, "varnish", AT(varnish), -1);
    plane_add(planes, places, &count, "salt", AT(salt), -1);
    plane_add(planes, places, &count, "brine", AT(brine), -1);
    for (int i = 0; i < 3; i++)
        plane_add(planes, places, &count, channels[i],
                  AT(substrate) + (size_t)i * sizeof(CM_field_id_t), -1);
    plane_add(planes, places, &count, "infused water", AT(page.water), -1);
    plane_add(planes, places, &count, "surface water", AT(surface_water), -1);
    plane_add(planes, places, &count, "wet around", AT(wet_around), -1);
    plane_add(planes, places, &count, "dried water", AT(dried), -1);
    planes[count - 1].whole = true;
    for (int i = 0; i < config->pigments_count; i++) {
        if (parts & (PAPER_PART_SURFACE | PAPER_PART_EDGE))
            plane_add(planes, places, &count, "surface pigment", AT(surface), i);
        plane_add(planes, places, &count, "infused pigment", AT(infused), i);
        if (parts & PAPER_PART_FIXING)
            plane_add(planes, places, &count, "fixed pigment", AT(fixed), i);
    }
#undef AT
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

enum paper_status sheet_plane_fetch(struct paper_sheet *p, int number, void *words)
{
    bool whole;
    CM_field_id_t field = plane_field(p, number, &whole);
    paper_enter(&p->page);
    CM_set_context();
    if (whole)
        u_array_read(p, words, field, SHEET_DRIED_BITS, CM_32_bit);
    else
        f_array_read(p, words, field);
    return paper_leave(&p->page);
}

void sheet_plane_write(struct paper_sheet *p, int number, const void *words)
{
    bool whole;
    CM_field_id_t field = plane_field(p, number, &whole);
    CM_set_context();
    if (whole)
        u_array_write(p, field, SHEET_DRIED_BITS, words, CM_32_bit);
    else
        f_array_write(p, field, words);
}

void sheet_planes_written(struct paper_sheet *p)
{
    CM_set_context();
    sheet_faces_make(p);
}
