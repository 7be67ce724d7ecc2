/* event.c - the table of events, and what follows from it: bytes, and other resolutions.
 *
 * Bytes: the members in the order of the table; numbers with their low byte first, doubles as IEEE's 64 bits, whole numbers 8
 * bytes with two's complement, flags and text as they are, a screen as width, height (4 bytes each) and its gray. */
#include "event.h"
#include "sheet_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum member_kind {
    MEMBER_DOUBLE,
    MEMBER_INT,
    MEMBER_WORD, /* uint64_t */
    MEMBER_FLAG,
    MEMBER_TEXT,        /* count characters, the last 0 */
    MEMBER_PLACE,       /* struct event_place */
    MEMBER_PAPER_PLACE, /* struct paper_place */
    MEMBER_PLANE,       /* const float *: one for each fiber */
    MEMBER_SAMPLES, /* samples and their count in struct paper_stroke, which is at offset 0 */
    MEMBER_AMOUNTS  /* the arrays of struct paper_print, which is at offset 0 */
};

/* What becomes of a number at another resolution: s fibers for one and t steps for one. */
enum member_scaling {
    SCALE_NOT,
    SCALE_LENGTH, /* s */
    SCALE_RATE,   /* 1/t: what happens in each fiber in a step */
    SCALE_SPREAD, /* s * s / t: part of a gradient that flows in a step */
    SCALE_PULL,   /* s / t: part of an amount that goes on by a fiber in a step */
    SCALE_PACE,   /* t: steps in a second */
};

struct member {
    enum member_kind kind;
    enum member_scaling scaling;
    size_t offset;
    int count;
    double least, most; /* of what is scaled; 0, 0: any */
};

#define MEMBER(type, member, kind, count)                                                      \
    {                                                                                          \
        MEMBER_##kind, SCALE_NOT, offsetof(struct type, member), count, 0, 0                   \
    }
#define SCALED(type, member, kind, count, how, least, most)                                    \
    {                                                                                          \
        MEMBER_##kind, SCALE_##how, offsetof(struct type, member), count, least, most          \
    }
#define LENGTH_OF(array) (sizeof(array) / sizeof *(array))

static const struct member air_members[] = {
    SCALED(paper_air, gravity, DOUBLE, 2, PULL, -1, 1),
    SCALED(paper_air, seep, DOUBLE, 2, PULL, -1, 1),
    SCALED(paper_air, spread, DOUBLE, 1, SPREAD, 0, 1),
    MEMBER(paper_air, tension, DOUBLE, 1),
    MEMBER(paper_air, relief, DOUBLE, 1),
    MEMBER(paper_air, film, DOUBLE, 1),
    MEMBER(paper_air, pinning, DOUBLE, 1),
    MEMBER(paper_air, damp, DOUBLE, 1),
    SCALED(paper_air, absorption, DOUBLE, 1, RATE, 0, 4),
    MEMBER(paper_air, carry, DOUBLE, 1),
    SCALED(paper_air, humidity, DOUBLE, 1, RATE, 0, 1),
    MEMBER(paper_air, edge, DOUBLE, 1),
    SCALED(paper_air, edge_width, DOUBLE, 1, LENGTH, 1, 32),
    SCALED(paper_air, settling, DOUBLE, 1, RATE, 0, 10),
    MEMBER(paper_air, thesis.gravity_x, DOUBLE, 1),
    MEMBER(paper_air, thesis.gravity_y, DOUBLE, 1),
    SCALED(paper_air, thesis.humidity, DOUBLE, 1, RATE, 0, 1),
    MEMBER(paper_air, thesis.molecular_weight, DOUBLE, 3),
};

static const struct member stock_members[] = {
    MEMBER(paper_stock, name, TEXT, PAPER_NAME_MAX),
    MEMBER(paper_stock, color, DOUBLE, 3),
    MEMBER(paper_stock, color_variation, DOUBLE, 1),
    SCALED(paper_stock, absorbency, DOUBLE, 1, SPREAD, 0, PAPER_ABSORBENCY_MAX),
    MEMBER(paper_stock, absorbency_variation, DOUBLE, 1),
    MEMBER(paper_stock, absorbency_along, DOUBLE, 2),
    MEMBER(paper_stock, capacity, DOUBLE, 2),
    MEMBER(paper_stock, roughness, DOUBLE, 1),
    SCALED(paper_stock, grain_px, DOUBLE, 1, LENGTH, 1, 64),
    SCALED(paper_stock, fiber_length, INT, 2, LENGTH, 1, 64),
};

static const struct member pigment_members[] = {
    MEMBER(paper_pigment, name, TEXT, PAPER_NAME_MAX),
    MEMBER(paper_pigment, weight, DOUBLE, 2),
    MEMBER(paper_pigment, density, DOUBLE, 1),
    MEMBER(paper_pigment, staining, DOUBLE, 1),
    MEMBER(paper_pigment, granulation, DOUBLE, 1),
    MEMBER(paper_pigment, k, DOUBLE, 3),
    MEMBER(paper_pigment, s, DOUBLE, 3),
    MEMBER(paper_pigment, takes, DOUBLE, 3),
};

static const struct member put_members[] = {
    MEMBER(event_put, place, PLACE, 1),
    MEMBER(event_put, amount, DOUBLE, 1 + PAPER_PIGMENTS_MAX),
};
static const struct member blot_members[] = {
    MEMBER(event_blot, place, PLACE, 1),
    MEMBER(event_blot, part, DOUBLE, 1),
    MEMBER(event_blot, lift, DOUBLE, 1),
};
static const struct member resist_members[] = {
    MEMBER(event_resist, place, PLACE, 1),
    MEMBER(event_resist, on, FLAG, 1),
};
static const struct member layer_members[] = {
    MEMBER(event_layer, layer, INT, 1),
    MEMBER(event_layer, pigment, INT, 1),
    MEMBER(event_layer, values, PLANE, 1),
};

static const struct member brush_members[] = {
    MEMBER(paper_brush, number, INT, 1),
    MEMBER(paper_brush, bristles, INT, 1),
    SCALED(paper_brush, width, DOUBLE, 1, LENGTH, 1, 1000),
    SCALED(paper_brush, depth, DOUBLE, 1, LENGTH, 1, 1000),
    MEMBER(paper_brush, angle, DOUBLE, 1),
    MEMBER(paper_brush, follows, FLAG, 1),
    MEMBER(paper_brush, flat, FLAG, 1),
    MEMBER(paper_brush, point, DOUBLE, 1),
    MEMBER(paper_brush, uneven, DOUBLE, 1),
    MEMBER(paper_brush, splay, DOUBLE, 1),
    MEMBER(paper_brush, bend, DOUBLE, 1),
    SCALED(paper_brush, thickness, DOUBLE, 1, LENGTH, 0, 100),
    SCALED(paper_brush, reach, DOUBLE, 1, LENGTH, 1, 1e6),
    MEMBER(paper_brush, load, DOUBLE, 1),
    MEMBER(paper_brush, flow, DOUBLE, 1),
    MEMBER(paper_brush, mixing, DOUBLE, 1),
    MEMBER(paper_brush, seed, WORD, 1),
    MEMBER(paper_brush, mirrored, FLAG, 1),
};
static const struct member dip_members[] = {
    MEMBER(paper_dip, number, INT, 1),
    MEMBER(paper_dip, part, DOUBLE, 1),
    MEMBER(paper_dip, side, DOUBLE, 2),
    MEMBER(paper_dip, amount, DOUBLE, 1 + PAPER_PIGMENTS_MAX),
};
static const struct member stroke_members[] = {
    MEMBER(paper_stroke, number, INT, 1),
    SCALED(paper_stroke, pace, DOUBLE, 1, PACE, 0, 10000),
    MEMBER(paper_stroke, samples, SAMPLES, 1),
};
static const struct member salt_members[] = {
    MEMBER(paper_salt, place, PAPER_PLACE, 1),
    SCALED(paper_salt, x, DOUBLE, 1, LENGTH, -1e6, 1e6),
    SCALED(paper_salt, y, DOUBLE, 1, LENGTH, -1e6, 1e6),
    SCALED(paper_salt, radius, DOUBLE, 1, LENGTH, 0, 1e5),
    MEMBER(paper_salt, grains, INT, 1),
    SCALED(paper_salt, size, DOUBLE, 2, LENGTH, 0.1, 50),
    MEMBER(paper_salt, strength, DOUBLE, 1),
    SCALED(paper_salt, reach, DOUBLE, 1, LENGTH, 1, 100),
    MEMBER(paper_salt, seed, WORD, 1),
};
static const struct member wash_members[] = {
    MEMBER(paper_wash, place, PAPER_PLACE, 1),
    SCALED(paper_wash, from, DOUBLE, 2, LENGTH, -1e6, 1e6),
    SCALED(paper_wash, to, DOUBLE, 2, LENGTH, -1e6, 1e6),
    MEMBER(paper_wash, amount, DOUBLE, 1 + PAPER_PIGMENTS_MAX),
    MEMBER(paper_wash, end, DOUBLE, 1 + PAPER_PIGMENTS_MAX),
};
static const struct member print_members[] = {MEMBER(paper_print, amount, AMOUNTS, 1)};
static const struct member lift_members[] = {
    MEMBER(paper_lift, place, PAPER_PLACE, 1),
    MEMBER(paper_lift, part, DOUBLE, 1),
};
static const struct member varnish_members[] = {
    MEMBER(paper_varnish, place, PAPER_PLACE, 1),
    MEMBER(paper_varnish, amount, DOUBLE, 1),
};

static enum paper_status stroke_check(const struct paper_sheet *p, const void *arguments)
{
    (void)p;
    return paper_stroke_check(arguments);
}

static enum paper_status air_set(struct paper_sheet *p, const void *arguments)
{
    p->air = *(const struct paper_air *)arguments;
    return PAPER_OK;
}

static const struct kind {
    const char *name; /* in files: never changed */
    size_t size;
    const struct member *members;
    size_t members_count;
    enum paper_status (*check)(const struct paper_sheet *, const void *); /* NULL: none */
    enum paper_status (*perform)(struct paper_sheet *, const void *);
} kinds[SHEET_EVENT_KINDS] = {
#define KIND(type, members) sizeof(struct type), members, LENGTH_OF(members)
    [SHEET_EVENT_STEP] = {"step", 0, NULL, 0, NULL, sheet_step},
    [SHEET_EVENT_AIR] = {"air", KIND(paper_air, air_members), sheet_air_check, air_set},
    [SHEET_EVENT_PUT] = {"put", KIND(event_put, put_members), sheet_put_check, sheet_put},
    [SHEET_EVENT_BLOT] = {"blot", KIND(event_blot, blot_members), sheet_blot_check, sheet_blot},
    [SHEET_EVENT_RESIST] = {"resist", KIND(event_resist, resist_members), sheet_resist_check,
                            sheet_resist},
    [SHEET_EVENT_DRY] = {"dry", 0, NULL, 0, NULL, sheet_dry},
    [SHEET_EVENT_SEAL] = {"seal", 0, NULL, 0, NULL, sheet_seal},
    [SHEET_EVENT_LAYER] = {"layer", KIND(event_layer, layer_members), sheet_layer_check,
                           sheet_layer},
    [SHEET_EVENT_BRUSH] = {"brush", KIND(paper_brush, brush_members), NULL, sheet_brush},
    [SHEET_EVENT_DIP] = {"dip", KIND(paper_dip, dip_members), NULL, sheet_dip},
    [SHEET_EVENT_STROKE] = {"stroke", KIND(paper_stroke, stroke_members), stroke_check,
                            sheet_stroke},
    [SHEET_EVENT_SALT] = {"salt", KIND(paper_salt, salt_members), NULL, sheet_salt},
    [SHEET_EVENT_WASH] = {"wash", KIND(paper_wash, wash_members), NULL, sheet_wash},
    [SHEET_EVENT_PRINT] = {"print", KIND(paper_print, print_members), NULL, sheet_print},
    [SHEET_EVENT_LIFT] = {"lift", KIND(paper_lift, lift_members), NULL, sheet_lift},
    [SHEET_EVENT_VARNISH] = {"varnish", KIND(paper_varnish, varnish_members), NULL,
                             sheet_varnish},
#undef KIND
};

const char *event_name(enum sheet_event_kind kind)
{
    return kinds[kind].name;
}

size_t event_size(enum sheet_event_kind kind)
{
    size_t size = 0;
    for (size_t i = 0; i < kinds[kind].members_count; i++) {
        const struct member *m = &kinds[kind].members[i];
        size += (size_t)m->count * (m->kind == MEMBER_FLAG || m->kind == MEMBER_TEXT ? 1 : 8);
    }
    return size;
}

int event_find(const char *name, size_t length)
{
    for (int i = 0; i < SHEET_EVENT_KINDS; i++)
        if (strlen(kinds[i].name) == length && memcmp(kinds[i].name, name, length) == 0)
            return i;
    return -1;
}

enum paper_status event_check(const struct paper_sheet *p, enum sheet_event_kind kind,
                              const void *arguments)
{
    return kinds[kind].check ? kinds[kind].check(p, arguments) : PAPER_OK;
}

enum paper_status event_perform(struct paper_sheet *p, enum sheet_event_kind kind,
                                const void *arguments)
{
    return kinds[kind].perform(p, arguments);
}

/* ---- bytes ---- */

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

/* What of the screen lies on the sheet. */
static void place_encode(struct event_bytes *b, const struct paper_sheet_config *config,
                         const struct event_place *place)
{
    event_put_number(b, place->everywhere, 1);
    if (place->everywhere)
        return;
    const struct paper_screen *screen = &place->screen;
    int64_t x1 = place->x > 0 ? place->x : 0, y1 = place->y > 0 ? place->y : 0;
    int64_t x2 = (int64_t)place->x + screen->width_px,
            y2 = (int64_t)place->y + screen->height_px;
    x2 = x2 < config->width ? x2 : config->width;
    y2 = y2 < config->height ? y2 : config->height;
    if (x1 >= x2 || y1 >= y2)
        x1 = y1 = x2 = y2 = 0;
    event_put_number(b, (uint64_t)x1, 4);
    event_put_number(b, (uint64_t)y1, 4);
    event_put_number(b, (uint64_t)(x2 - x1), 4);
    event_put_number(b, (uint64_t)(y2 - y1), 4);
    for (int64_t y = y1; y < y2; y++)
        event_put_bytes(
            b, screen->gray + (y - place->y) * (int64_t)screen->width_px + (x1 - place->x),
            (size_t)(x2 - x1));
}

enum { SAMPLE_NUMBERS = sizeof(struct paper_stroke_sample) / sizeof(double) };
_Static_assert(sizeof(struct paper_stroke_sample) == 6 * sizeof(double), "six doubles");

/* Its rectangle, and for each substance whether there is an array, and the array. A rectangle that cannot be is kept, without
 * arrays, so that it can be refused. */
static void amounts_encode(struct event_bytes *b, const struct paper_sheet_config *config,
                           const struct paper_print *print)
{
    const int rectangle[4] = {print->x, print->y, print->width, print->height};
    bool good = print->width > 0 && print->height > 0 && print->width <= PAPER_SIDE_MAX &&
                print->height <= PAPER_SIDE_MAX;
    for (int i = 0; i < 4; i++)
        event_put_number(b, (uint64_t)(int64_t)rectangle[i], 8);
    for (int i = 0; i <= config->pigments_count; i++) {
        const float *amounts = good ? print->amount[i] : NULL;
        event_put_number(b, amounts != NULL, 1);
        if (amounts)
            event_put_bytes(b, amounts,
                            (size_t)print->width * (size_t)print->height * sizeof *amounts);
    }
}

static void members_encode(struct event_bytes *b, const struct paper_sheet_config *config,
                           const struct member *members, size_t count, const void *of)
{
    for (const struct member *m = members; m < members + count; m++) {
        const char *at = (const char *)of + m->offset;
        const void *start = at;
        switch (m->kind) {
        case MEMBER_DOUBLE:
            for (int i = 0; i < m->count; i++)
                event_put_double(b, ((const double *)start)[i]);
            break;
        case MEMBER_INT:
            for (int i = 0; i < m->count; i++)
                event_put_number(b, (uint64_t)(int64_t)((const int *)start)[i], 8);
            break;
        case MEMBER_WORD:
            event_put_number(b, *(const uint64_t *)start, 8);
            break;
        case MEMBER_FLAG:
            event_put_number(b, *(const bool *)start, 1);
            break;
        case MEMBER_TEXT:
            event_put_bytes(b, at, (size_t)m->count);
            break;
        case MEMBER_PLACE:
            place_encode(b, config, start);
            break;
        case MEMBER_PAPER_PLACE: {
            const struct paper_place *place = start;
            struct event_place held = {!place->screen, place->x, place->y, {0}};
            if (place->screen)
                held.screen = *place->screen;
            place_encode(b, config, &held);
            break;
        }
        case MEMBER_SAMPLES: {
            const struct paper_stroke *stroke = of;
            event_put_number(b, (uint64_t)stroke->samples_count, 4);
            for (int i = 0; i < stroke->samples_count; i++) {
                double numbers[SAMPLE_NUMBERS];
                memcpy(numbers, &stroke->samples[i], sizeof numbers);
                for (int j = 0; j < SAMPLE_NUMBERS; j++)
                    event_put_double(b, numbers[j]);
            }
            break;
        }
        case MEMBER_AMOUNTS:
            amounts_encode(b, config, of);
            break;
        case MEMBER_PLANE: { /* floats are kept as they are: low byte first here and on every machine this runs on */
            _Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "low byte first");
            const float *values;
            memcpy(&values, at, sizeof values);
            event_put_bytes(b, values,
                            (size_t)config->width * (size_t)config->height * sizeof *values);
            break;
        }
        }
    }
}

void event_encode(struct event_bytes *b, const struct paper_sheet_config *config,
                  enum sheet_event_kind kind, const void *arguments)
{
    members_encode(b, config, kinds[kind].members, kinds[kind].members_count, arguments);
}

/* NULL with r->bad, or without it where there is no memory. */
static uint8_t *copy_get(struct event_reader *r, size_t count)
{
    const uint8_t *bytes = event_get_bytes(r, count);
    uint8_t *copy = bytes ? malloc(count) : NULL;
    if (copy)
        memcpy(copy, bytes, count);
    return copy;
}

/* A screen that has nothing is one dot of 0, so that every place has a screen that can be put. */
static bool place_decode(struct event_reader *r, const struct paper_sheet_config *config,
                         struct event_place *place)
{
    place->everywhere = event_get_number(r, 1) != 0;
    if (place->everywhere)
        return true;
    uint64_t x = event_get_number(r, 4), y = event_get_number(r, 4),
             width = event_get_number(r, 4), height = event_get_number(r, 4);
    uint64_t most_x = (uint64_t)config->width, most_y = (uint64_t)config->height;
    if (x > most_x || y > most_y || width > most_x - x || height > most_y - y ||
        (width == 0) != (height == 0))
        r->bad = true;
    if (r->bad)
        return true;
    place->x = (int)x;
    place->y = (int)y;
    place->screen.width_px = width ? (int)width : 1;
    place->screen.height_px = height ? (int)height : 1;
    place->screen.gray = width ? copy_get(r, (size_t)(width * height)) : calloc(1, 1);
    return r->bad || place->screen.gray;
}

static bool samples_decode(struct event_reader *r, struct paper_stroke *stroke)
{
    uint64_t count = event_get_number(r, 4);
    if (count > PAPER_STROKE_SAMPLES_MAX || count == 0 ||
        count * sizeof(struct paper_stroke_sample) > (size_t)(r->end - r->at))
        r->bad = true;
    if (r->bad)
        return true;
    struct paper_stroke_sample *samples = malloc((size_t)count * sizeof *samples);
    if (!samples)
        return false;
    for (uint64_t i = 0; i < count; i++) {
        double numbers[SAMPLE_NUMBERS];
        for (int j = 0; j < SAMPLE_NUMBERS; j++)
            numbers[j] = event_get_double(r);
        memcpy(&samples[i], numbers, sizeof numbers);
    }
    stroke->samples_count = (int)count;
    stroke->samples = samples;
    return true;
}

static bool amounts_decode(struct event_reader *r, const struct paper_sheet_config *config,
                           struct paper_print *print)
{
    int *const rectangle[4] = {&print->x, &print->y, &print->width, &print->height};
    for (int i = 0; i < 4; i++) {
        int64_t number = (int64_t)event_get_number(r, 8);
        r->bad = r->bad || number < -PAPER_SIDE_MAX * 64 || number > PAPER_SIDE_MAX * 64;
        *rectangle[i] = r->bad ? 0 : (int)number;
    }
    if (print->width < 1 || print->height < 1 || print->width > PAPER_SIDE_MAX ||
        print->height > PAPER_SIDE_MAX)
        r->bad = true;
    for (int i = 0; i <= config->pigments_count && !r->bad; i++) {
        if (event_get_number(r, 1) == 0 || r->bad)
            continue;
        uint8_t *amounts =
            copy_get(r, (size_t)print->width * (size_t)print->height * sizeof(float));
        if (!amounts && !r->bad)
            return false;
        memcpy(&print->amount[i], &amounts, sizeof amounts);
    }
    return true;
}

/* False where memory is short. */
static bool members_decode(struct event_reader *r, const struct paper_sheet_config *config,
                           const struct member *members, size_t count, void *of)
{
    bool memory = true;
    for (const struct member *m = members; m < members + count && !r->bad && memory; m++) {
        char *at = (char *)of + m->offset;
        void *start = at;
        const uint8_t *bytes;
        switch (m->kind) {
        case MEMBER_DOUBLE:
            for (int i = 0; i < m->count; i++)
                ((double *)start)[i] = event_get_double(r);
            break;
        case MEMBER_INT:
            for (int i = 0; i < m->count; i++) {
                int64_t number = (int64_t)event_get_number(r, 8);
                r->bad = r->bad || number < INT32_MIN || number > INT32_MAX;
                ((int *)start)[i] = r->bad ? 0 : (int)number;
            }
            break;
        case MEMBER_WORD:
            *(uint64_t *)start = event_get_number(r, 8);
            break;
        case MEMBER_FLAG:
            *(bool *)start = event_get_number(r, 1) != 0;
            break;
        case MEMBER_TEXT:
            bytes = event_get_bytes(r, (size_t)m->count);
            r->bad = r->bad || memchr(bytes, '\0', (size_t)m->count) == NULL;
            if (!r->bad)
                memcpy(at, bytes, (size_t)m->count);
            break;
        case MEMBER_PLACE:
            memory = place_decode(r, config, start);
            break;
        case MEMBER_PAPER_PLACE: {
            struct event_place held = {0};
            struct paper_place *place = start;
            memory = place_decode(r, config, &held);
            *place = (struct paper_place){.x = held.x, .y = held.y};
            if (memory && !r->bad && !held.everywhere) {
                struct paper_screen *screen = malloc(sizeof *screen);
                memory = screen != NULL;
                if (memory)
                    *screen = held.screen;
                else
                    free(held.screen.gray);
                place->screen = screen;
            }
            break;
        }
        case MEMBER_SAMPLES:
            memory = samples_decode(r, of);
            break;
        case MEMBER_AMOUNTS:
            memory = amounts_decode(r, config, of);
            break;
        case MEMBER_PLANE: {
            uint8_t *values =
                copy_get(r, (size_t)config->width * (size_t)config->height * sizeof(float));
            memory = values || r->bad;
            memcpy(at, &values, sizeof values);
            break;
        }
        }
    }
    return memory;
}

enum paper_status event_decode(const uint8_t *bytes, size_t count,
                               const struct paper_sheet_config *config,
                               enum sheet_event_kind kind, void **arguments)
{
    const struct kind *k = &kinds[kind];
    struct event_reader r = {bytes, bytes + count, false};
    *arguments = NULL;
    if (k->size == 0)
        return count == 0 ? PAPER_OK
                          : paper_fail(PAPER_BAD_FILE, "an event (%s) is damaged", k->name);
    void *made = calloc(1, k->size);
    bool memory = made && members_decode(&r, config, k->members, k->members_count, made);
    if (!memory || r.bad || r.at != r.end) {
        event_free(kind, made);
        return memory ? paper_fail(PAPER_BAD_FILE, "an event (%s) is damaged", k->name)
                      : paper_fail(PAPER_NO_MEMORY, "no memory for an event (%s)", k->name);
    }
    *arguments = made;
    return PAPER_OK;
}

void event_free(enum sheet_event_kind kind, void *arguments)
{
    const struct kind *k = &kinds[kind];
    for (size_t i = 0; arguments && i < k->members_count; i++) {
        char *at = (char *)arguments + k->members[i].offset;
        void *start = at, *held = NULL;
        if (k->members[i].kind == MEMBER_PLACE)
            held = ((struct event_place *)start)->screen.gray;
        if (k->members[i].kind == MEMBER_PLANE || k->members[i].kind == MEMBER_SAMPLES)
            memcpy(&held, at, sizeof held);
        if (k->members[i].kind == MEMBER_PAPER_PLACE) {
            struct paper_screen *screen;
            memcpy(&screen, at + offsetof(struct paper_place, screen), sizeof screen);
            if (screen)
                free(screen->gray);
            held = screen;
        }
        for (int j = 0; k->members[i].kind == MEMBER_AMOUNTS && j <= PAPER_PIGMENTS_MAX; j++) {
            void *amounts;
            memcpy(&amounts, at + (size_t)j * sizeof amounts, sizeof amounts);
            free(amounts);
        }
        free(held);
    }
    free(arguments);
}

void event_config_encode(struct event_bytes *b, const struct paper_sheet_config *config)
{
    event_put_number(b, (uint64_t)config->width, 4);
    event_put_number(b, (uint64_t)config->height, 4);
    event_put_number(b, config->torus, 1);
    event_put_number(b, config->parts, 4);
    event_put_number(b, (uint64_t)config->rule, 4);
    event_put_number(b, config->seed, 8);
    event_put_number(b, (uint64_t)config->pigments_count, 4);
    members_encode(b, config, stock_members, LENGTH_OF(stock_members), &config->stock);
    for (int i = 0; i < config->pigments_count; i++)
        members_encode(b, config, pigment_members, LENGTH_OF(pigment_members),
                       &config->pigments[i]);
}

enum paper_status event_config_decode(struct event_reader *r, struct paper_sheet_config *config)
{
    memset(config, 0, sizeof *config);
    uint64_t width = event_get_number(r, 4), height = event_get_number(r, 4);
    config->torus = event_get_number(r, 1) != 0;
    config->parts = (unsigned)event_get_number(r, 4);
    uint64_t rule = event_get_number(r, 4);
    config->seed = event_get_number(r, 8);
    uint64_t pigments = event_get_number(r, 4);
    if (width < PAPER_SIDE_MIN || width > PAPER_SIDE_MAX || height < PAPER_SIDE_MIN ||
        height > PAPER_SIDE_MAX || rule > PAPER_RULE_LUMINOUS || pigments > PAPER_PIGMENTS_MAX)
        r->bad = true;
    if (!r->bad) {
        config->width = (int)width;
        config->height = (int)height;
        config->rule = (enum paper_rule)rule;
        config->pigments_count = (int)pigments;
        members_decode(r, config, stock_members, LENGTH_OF(stock_members), &config->stock);
    }
    for (int i = 0; i < config->pigments_count; i++)
        members_decode(r, config, pigment_members, LENGTH_OF(pigment_members),
                       &config->pigments[i]);
    return r->bad ? paper_fail(PAPER_BAD_FILE, "the description of the sheet is damaged")
                  : PAPER_OK;
}

void event_air_encode(struct event_bytes *b, const struct paper_air *air)
{
    members_encode(b, NULL, air_members, LENGTH_OF(air_members), air);
}

void event_air_decode(struct event_reader *r, struct paper_air *air)
{
    memset(air, 0, sizeof *air);
    members_decode(r, NULL, air_members, LENGTH_OF(air_members), air);
}

/* ---- at another resolution ---- */

/* Weights of the sources of one place along a row: a tent two sources wide, or two new places wide where these are fewer. */
struct tent {
    int first, count;
    double weights[512];
};

static void tent_make(struct tent *tent, int place, double scale)
{
    double center = (place + 0.5) / scale - 0.5, reach = scale < 1 ? 1 / scale : 1;
    reach = reach < 250 ? reach : 250;
    tent->first = (int)floor(center - reach) + 1;
    tent->count = 0;
    double sum = 0;
    for (int i = tent->first; i < center + reach && tent->count < 512; i++) {
        double weight = 1 - fabs(i - center) / reach;
        tent->weights[tent->count++] = weight;
        sum += weight;
    }
    for (int i = 0; i < tent->count; i++)
        tent->weights[i] /= sum;
}

/* new[x, y] of a grid whose 0, 0 is at x0, y0 of the new sheet, from an old one whose 0, 0 is at old_x, old_y of the old sheet.
 * Beyond the edge there is 0, or what is at the edge. */
struct resampled {
    double scale;
    int x0, y0, width, height;
    int old_x, old_y, old_width, old_height;
    bool edge_goes_on;
};

static bool resample(const struct resampled *r, const float *old, float *new)
{
    size_t width = (size_t)r->width, old_width = (size_t)r->old_width;
    float *rows = calloc(width * (size_t)r->old_height, sizeof *rows);
    struct tent *tent = malloc(sizeof *tent);
    for (int x = 0; rows && tent && x < r->width; x++) {
        tent_make(tent, x + r->x0, r->scale);
        for (int y = 0; y < r->old_height; y++) {
            double sum = 0;
            for (int i = 0; i < tent->count; i++) {
                int at = tent->first + i - r->old_x, last = r->old_width - 1;
                if (r->edge_goes_on)
                    at = at < 0 ? 0 : at > last ? last : at;
                if (at >= 0 && at <= last)
                    sum += tent->weights[i] * (double)old[(size_t)y * old_width + (size_t)at];
            }
            rows[(size_t)y * width + (size_t)x] = (float)sum;
        }
    }
    for (int y = 0; rows && tent && y < r->height; y++) {
        tent_make(tent, y + r->y0, r->scale);
        for (int x = 0; x < r->width; x++) {
            double sum = 0;
            for (int i = 0; i < tent->count; i++) {
                int at = tent->first + i - r->old_y, last = r->old_height - 1;
                if (r->edge_goes_on)
                    at = at < 0 ? 0 : at > last ? last : at;
                if (at >= 0 && at <= last)
                    sum += tent->weights[i] * (double)rows[(size_t)at * width + (size_t)x];
            }
            new[(size_t)y * width + (size_t)x] = (float)sum;
        }
    }
    bool done = rows && tent;
    free(rows);
    free(tent);
    return done;
}

static bool place_scale(struct event_place *place, const struct event_scaling *scaling)
{
    if (place->everywhere)
        return true;
    struct paper_screen *screen = &place->screen;
    struct resampled r = {.scale = scaling->length,
                          .old_x = place->x,
                          .old_y = place->y,
                          .old_width = screen->width_px,
                          .old_height = screen->height_px};
    double s = scaling->length;
    /* edges of a pixel of the old sheet spread over as much of the new one */
    r.x0 = (int)fmax(0, floor((place->x - 1) * s));
    r.y0 = (int)fmax(0, floor((place->y - 1) * s));
    int x1 = (int)fmin(scaling->new_width, ceil((place->x + screen->width_px + 1) * s));
    int y1 = (int)fmin(scaling->new_height, ceil((place->y + screen->height_px + 1) * s));
    r.width = x1 > r.x0 ? x1 - r.x0 : 1;
    r.height = y1 > r.y0 ? y1 - r.y0 : 1;
    size_t old_count = (size_t)r.old_width * (size_t)r.old_height,
           count = (size_t)r.width * (size_t)r.height;
    float *old = malloc(old_count * sizeof *old), *new = malloc(count * sizeof *new);
    uint8_t *gray = malloc(count);
    bool done = old && new &&gray;
    for (size_t i = 0; done && i < old_count; i++)
        old[i] = screen->gray[i];
    done = done && resample(&r, old, new);
    if (done) {
        for (size_t i = 0; i < count; i++)
            gray[i] = (uint8_t)lrintf(new[i]);
        free(screen->gray);
        *screen =
            (struct paper_screen){.width_px = r.width, .height_px = r.height, .gray = gray};
        place->x = r.x0;
        place->y = r.y0;
        gray = NULL;
    }
    free(gray);
    free(old);
    free(new);
    return done;
}

static bool plane_scale(const float **values, const struct event_scaling *scaling)
{
    struct resampled r = {.scale = scaling->length,
                          .width = scaling->new_width,
                          .height = scaling->new_height,
                          .old_width = scaling->width,
                          .old_height = scaling->height,
                          .edge_goes_on = true};
    float *new = malloc((size_t)r.width * (size_t)r.height * sizeof *new), *old;
    memcpy(&old, values, sizeof old);
    bool done = new &&resample(&r, old, new);
    free(done ? old : new);
    if (done)
        *values = new;
    return done;
}

static bool paper_place_scale(struct paper_place *place, const struct event_scaling *scaling)
{
    struct event_place held = {!place->screen, place->x, place->y, {0}};
    if (!place->screen)
        return true;
    held.screen = *place->screen;
    if (!place_scale(&held, scaling))
        return false;
    struct paper_screen *screen;
    memcpy(&screen, &place->screen, sizeof screen);
    *screen = held.screen;
    place->x = held.x;
    place->y = held.y;
    return true;
}

static void samples_scale(struct paper_stroke *stroke, const struct event_scaling *scaling)
{
    struct paper_stroke_sample *samples;
    memcpy(&samples, &stroke->samples, sizeof samples);
    for (int i = 0; i < stroke->samples_count; i++) {
        samples[i].x *= scaling->length;
        samples[i].y *= scaling->length;
    }
}

static bool amounts_scale(struct paper_print *print, const struct event_scaling *scaling)
{
    double s = scaling->length;
    struct resampled r = {.scale = s,
                          .x0 = (int)floor(print->x * s),
                          .y0 = (int)floor(print->y * s),
                          .width = (int)fmin(PAPER_SIDE_MAX, fmax(1, round(print->width * s))),
                          .height =
                              (int)fmin(PAPER_SIDE_MAX, fmax(1, round(print->height * s))),
                          .old_x = print->x,
                          .old_y = print->y,
                          .old_width = print->width,
                          .old_height = print->height,
                          .edge_goes_on = true};
    bool done = true;
    for (int i = 0; i <= PAPER_PIGMENTS_MAX && done; i++) {
        if (!print->amount[i])
            continue;
        float *new = malloc((size_t)r.width * (size_t)r.height * sizeof *new), *old;
        memcpy(&old, &print->amount[i], sizeof old);
        done = new &&resample(&r, old, new);
        free(done ? old : new);
        if (done)
            print->amount[i] = new;
    }
    print->x = r.x0;
    print->y = r.y0;
    print->width = r.width;
    print->height = r.height;
    return done;
}

static double number_scale(const struct member *m, double value, double length, double pace)
{
    switch (m->scaling) {
    case SCALE_NOT:
        return value;
    case SCALE_LENGTH:
        value *= length;
        break;
    case SCALE_RATE:
        value /= pace;
        break;
    case SCALE_SPREAD:
        value *= length * length / pace;
        break;
    case SCALE_PULL:
        value *= length / pace;
        break;
    case SCALE_PACE:
        value *= pace;
        break;
    }
    return m->least < m->most ? fmin(m->most, fmax(m->least, value)) : value;
}

static bool members_scale(const struct member *members, size_t count, void *of,
                          const struct event_scaling *scaling)
{
    bool memory = true;
    for (const struct member *m = members; m < members + count && memory; m++) {
        void *start = (char *)of + m->offset;
        if (m->kind == MEMBER_PLACE)
            memory = place_scale(start, scaling);
        else if (m->kind == MEMBER_PAPER_PLACE)
            memory = paper_place_scale(start, scaling);
        else if (m->kind == MEMBER_SAMPLES)
            samples_scale(of, scaling);
        else if (m->kind == MEMBER_AMOUNTS)
            memory = amounts_scale(of, scaling);
        else if (m->kind == MEMBER_PLANE)
            memory = plane_scale(start, scaling);
        else if (m->scaling != SCALE_NOT)
            for (int i = 0; i < m->count; i++) {
                if (m->kind == MEMBER_DOUBLE)
                    ((double *)start)[i] =
                        number_scale(m, ((double *)start)[i], scaling->length, scaling->pace);
                else if (m->kind == MEMBER_INT)
                    ((int *)start)[i] = (int)lround(
                        number_scale(m, ((int *)start)[i], scaling->length, scaling->pace));
            }
    }
    return memory;
}

enum paper_status event_scale(enum sheet_event_kind kind, void *arguments,
                              const struct event_scaling *scaling)
{
    if (!members_scale(kinds[kind].members, kinds[kind].members_count, arguments, scaling))
        return paper_fail(PAPER_NO_MEMORY, "no memory for an event (%s) at another resolution",
                          kinds[kind].name);
    return PAPER_OK;
}

void event_config_scale(struct paper_sheet_config *config, const struct event_scaling *scaling)
{
    config->width = scaling->new_width;
    config->height = scaling->new_height;
    members_scale(stock_members, LENGTH_OF(stock_members), &config->stock, scaling);
}
