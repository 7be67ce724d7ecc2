/* boxes.c - a step costs what is wet, not what the sheet is: steps of water that flows are computed in boxes around what can change.
 *
 * A fiber is at rest where there is no water, nothing flows, wet_around and brine are 0, and no pigment in the fibers still settles. A
 * fiber at rest among fibers at rest stays as it is, to the bit: every flow has a factor that is 0. In a step activity spreads by one
 * fiber, and by as many as wet_around reaches.
 *
 *      +------------------------------+
 *      | sheet        +----------+    |      A box is a VP set of its own, of a few lengths (boxes_find.h), so that its kernels are
 *      |              |   box    |    |      made once. Fields are copied into it, the same step runs there, and what it has changed
 *      |              |  ~~~~~   |    |      is copied back when somebody looks at the sheet. It is a torus like every VP set: as
 *      |              | ~active~ |    |      long as what is active stays away from its sides, fibers there are at rest whatever
 *      |              |  ~~~~~   |    |      lies beyond.
 *      |              +----------+    |
 *      +------------------------------+
 *
 * So a step in boxes gives the same bits as one of the whole sheet. The boxes are good for as many steps as what is active is away
 * from their sides; then they are looked at again, and cut anew where it has come too near or has shrunk. Whoever changes the sheet
 * closes them. Where more than a half would lie in boxes there are none, and the sheet is looked at again some steps later. */
#include "model/boxes_find.h"
#include "model/model.h"

#include <limits.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum {
    UNIT_USUAL = 64,
    SHEET_LEAST = 64, /* units x units: a step of less takes no longer than a box's beginning */
    PARTS_MOST = 2 * BOXES_MOST,
    WAIT_LEAST = 24, /* steps until a sheet that had no boxes is looked at again */
    WAIT_MOST = 384
};
#define SHARE_MOST 0.5    /* of the sheet, in boxes */
#define SHRUNK 0.6        /* of their area, from which boxes are cut anew */
#define SETTLED_LEAST 4.5 /* grains that settle at 1 / 10 of the pace: fewer than a half stay */

/* A box on the machine. Of the sheet it has what a step needs. */
struct part {
    struct paper_sheet sheet;
    struct box box;
    bool open;
};

struct sheet_boxes {
    struct part *parts[PARTS_MOST];
    bool confined; /* steps are done in the open parts */
    bool ahead;    /* they are newer than the sheet's own fields */
    int good;      /* steps for which they can be used */
    int wait;      /* steps until the sheet is looked at */
    int wait_next;
    double share;         /* of the sheet, that the last step computed */
    struct paper_air air; /* by which they were made */
    void *words;          /* of the largest open part */
};

/* ---- which fields ---- */

struct copied {
    CM_field_id_t sheet, part;
    unsigned bits; /* 0: a float */
    bool changes;
};
enum { COPIED_MOST = 20 + 3 * PAPER_PIGMENTS_MAX };

static int copied_fields(const struct paper_sheet *p, const struct paper_sheet *part,
                         struct copied all[COPIED_MOST])
{
    const bool surface = sheet_has(p, PAPER_PART_SURFACE);
    const struct {
        size_t member;
        bool there, changes;
    } rows[] = {
#define ROW(member, there, changes) {offsetof(struct paper_sheet, member), there, changes}
        ROW(height, true, false),          ROW(page.absorbency, true, false),
        ROW(capacity, true, false),        ROW(face[0], true, false),
        ROW(face[1], true, false),         ROW(sizing, surface, false),
        ROW(ease[0], surface, false),      ROW(ease[1], surface, false),
        ROW(swirl, surface, false),        ROW(page.water, true, true),
        ROW(surface_water, surface, true), ROW(wet_around, surface, true),
        ROW(wet_part, surface, true),      ROW(speed[0], surface, true),
        ROW(speed[1], surface, true),      ROW(salt, p->salted, true),
        ROW(brine, p->salted, true),
#undef ROW
    };
    int count = 0;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct copied *c = &all[count];
        memcpy(&c->sheet, (const char *)p + rows[i].member, sizeof c->sheet);
        memcpy(&c->part, (const char *)part + rows[i].member, sizeof c->part);
        c->bits = 0;
        c->changes = rows[i].changes;
        count += rows[i].there;
    }
    all[count++] = (struct copied){p->dried, part->dried, SHEET_DRIED_BITS, true};
    for (int i = 0; i < p->config.pigments_count; i++) {
        CM_field_id_t of_sheet[3], of_part[3];
        const int fields = sheet_pigment_fields(p, i, of_sheet);
        sheet_pigment_fields(part, i, of_part);
        for (int k = 0; k < fields; k++)
            all[count++] = (struct copied){of_sheet[k], of_part[k], 0, true};
    }
    return count;
}

/* Calls block_do() for each of the up to four blocks of the sheet that a box is made of: it may go over the sheet's edge. */
static void blocks_each(const struct paper_sheet *p, const struct box *box, CM_field_id_t field,
                        unsigned bits, void *words, bool read)
{
    const int width = p->page.grid.width, height = p->page.grid.height;
    for (int row = 0; row < box->height;) {
        const int y = (box->y + row) % height,
                  rows = box->height - row < height - y ? box->height - row : height - y;
        for (int column = 0; column < box->width;) {
            const int x = (box->x + column) % width, left = box->width - column,
                      columns = left < width - x ? left : width - x;
            const struct kit_block block = {x,      y,   columns,    rows,
                                            column, row, box->width, box->height};
            if (read)
                kit_grid_block_read(&block, words, field, bits);
            else
                kit_grid_block_write(&block, field, bits, words);
            column += columns;
        }
        row += rows;
    }
}

static void part_fill(struct paper_sheet *p, struct part *part, void *words)
{
    struct copied all[COPIED_MOST];
    const int count = copied_fields(p, &part->sheet, all);
    const struct kit_grid *grid = &part->sheet.page.grid;
    for (int i = 0; i < count; i++) {
        CM_set_vp_set(p->page.grid.vp_set);
        blocks_each(p, &part->box, all[i].sheet, all[i].bits, words, true);
        CM_set_vp_set(grid->vp_set);
        if (all[i].bits)
            kit_grid_u_write(grid, all[i].part, all[i].bits, words, CM_32_bit);
        else
            kit_grid_f_write(grid, all[i].part, words);
    }
}

static void part_give(struct paper_sheet *p, const struct part *part, void *words)
{
    struct copied all[COPIED_MOST];
    const int count = copied_fields(p, &part->sheet, all);
    const struct kit_grid *grid = &part->sheet.page.grid;
    for (int i = 0; i < count; i++) {
        if (!all[i].changes)
            continue;
        CM_set_vp_set(grid->vp_set);
        if (all[i].bits)
            kit_grid_u_read(grid, words, all[i].part, all[i].bits, CM_32_bit);
        else
            kit_grid_f_read(grid, words, all[i].part);
        CM_set_vp_set(p->page.grid.vp_set);
        blocks_each(p, &part->box, all[i].sheet, all[i].bits, words, false);
    }
}

/* ---- parts ---- */

static void part_destroy(struct part *part)
{
    kit_grid_free(&part->sheet.page.grid);
    free(part);
}

void sheet_boxes_destroy(struct paper_sheet *p)
{
    struct sheet_boxes *b = p->boxes;
    if (!b)
        return;
    for (int i = 0; i < PARTS_MOST; i++)
        if (b->parts[i])
            part_destroy(b->parts[i]);
    free(b->words);
    free(b);
    p->boxes = NULL;
}

/* A part that is as large as the box and not open; a new one if there is none. */
static enum paper_status part_get(struct paper_sheet *p, const struct box *box,
                                  struct part **out)
{
    struct sheet_boxes *b = p->boxes;
    int free_place = -1, closed = -1;
    for (int i = 0; i < PARTS_MOST; i++) {
        struct part *part = b->parts[i];
        if (!part)
            free_place = i;
        else if (!part->open && part->box.width == box->width &&
                 part->box.height == box->height) {
            *out = part;
            part->box = *box;
            part->open = true;
            return PAPER_OK;
        } else if (!part->open)
            closed = i;
    }
    if (free_place < 0) { /* more than are open at once */
        part_destroy(b->parts[closed]);
        b->parts[closed] = NULL;
        free_place = closed;
    }
    struct part *part = calloc(1, sizeof *part);
    if (!part)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a part of a sheet");
    struct paper_sheet *s = &part->sheet;
    s->config = p->config;
    s->config.width = box->width;
    s->config.height = box->height;
    s->unit = p->unit;
    s->finer = p->finer;
    kit_grid_make(&s->page.grid, box->width, box->height);
    sheet_fields_make(s);
    part->box = *box;
    part->open = true;
    b->parts[free_place] = *out = part;
    return paper_leave(&s->page);
}

/* Parts that are closed stay, as long as they and the open ones take no more than boxes may. */
static void parts_closed_few(struct paper_sheet *p)
{
    struct sheet_boxes *b = p->boxes;
    double room = SHARE_MOST * p->page.grid.width * p->page.grid.height;
    for (int i = 0; i < PARTS_MOST; i++)
        if (b->parts[i] && b->parts[i]->open)
            room -= (double)b->parts[i]->box.width * b->parts[i]->box.height;
    for (int i = 0; i < PARTS_MOST; i++) {
        if (!b->parts[i] || b->parts[i]->open)
            continue;
        room -= (double)b->parts[i]->box.width * b->parts[i]->box.height;
        if (room < 0) {
            part_destroy(b->parts[i]);
            b->parts[i] = NULL;
        }
    }
}

static void parts_close(struct sheet_boxes *b)
{
    for (int i = 0; i < PARTS_MOST; i++)
        if (b->parts[i])
            b->parts[i]->open = false;
    b->confined = b->ahead = false;
    b->wait = 0;
    b->wait_next = WAIT_LEAST;
}

/* ---- whoever looks ---- */

void sheet_look(struct paper_sheet *p)
{
    struct sheet_boxes *b = p->boxes;
    paper_enter(&p->page);
    if (!b || !b->ahead)
        return;
    for (int i = 0; i < PARTS_MOST; i++)
        if (b->parts[i] && b->parts[i]->open)
            part_give(p, b->parts[i], b->words);
    b->ahead = false;
}

void sheet_change(struct paper_sheet *p)
{
    sheet_look(p);
    if (p->boxes)
        parts_close(p->boxes);
}

void sheet_change_all(struct paper_sheet *p)
{
    if (p->boxes)
        parts_close(p->boxes);
    paper_enter(&p->page);
}

/* ---- what is active ---- */

/* Fibers that a step's activity may spread by. */
static int spread_in_a_step(const struct paper_sheet *p)
{
    return sheet_has(p, PAPER_PART_SURFACE) ? sheet_around_reach(p) : 1;
}

/* mask = 1 where a fiber is not at rest. All that is added is 0 or more. Uses t[0], t[1]. */
static void active_make(struct paper_sheet *p)
{
    CM_field_id_t sum = p->t[0], part = p->t[1];
    const bool surface = sheet_has(p, PAPER_PART_SURFACE);
    kit_f_copy(sum, p->page.water);
    if (surface) {
        kit_f_add(sum, sum, p->surface_water);
        kit_f_add(sum, sum, p->wet_around);
        kit_f_add(sum, sum, p->wet_part);
    }
    for (int axis = 0; axis < 2 && surface; axis++) {
        kit_f_times(part, p->speed[axis], -1.0);
        kit_f_max(part, part, p->speed[axis]);
        kit_f_add(sum, sum, part);
    }
    if (p->salted)
        kit_f_add(sum, sum, p->brine);
    for (int i = 0; i < p->config.pigments_count; i++) {
        const double pace = sheet_settling_pace(p, i);
        if (surface)
            kit_f_add(sum, sum, p->surface[i]);
        if (!surface || !sheet_has(p, PAPER_PART_FIXING) || !(pace > 0))
            continue;
        kit_f_plus(part, p->infused[i], -floor(SETTLED_LEAST / fmin(1, pace)));
        kit_f_least(part, part, 0.0);
        kit_f_add(sum, sum, part);
    }
    CM_u_move_constant_1L(p->mask, 0, 8);
    CM_f_gt_constant_1L(sum, 0.0, KIT_F);
    CM_logand_context_with_test();
    CM_u_move_constant_1L(p->mask, 1, 8);
    CM_set_context();
    kit_f_set(sum, 0.0);
    kit_f_set(part, 0.0);
}

static void active_read(struct paper_sheet *p, uint8_t *active)
{
    CM_set_vp_set(p->page.grid.vp_set);
    CM_set_context();
    active_make(p);
    kit_grid_u_read(&p->page.grid, active, p->mask, 8, CM_8_bit);
}

static struct boxes_wish wish_of(const struct paper_sheet *p)
{
    return (struct boxes_wish){p->page.grid.width, p->page.grid.height, p->boxes_unit,
                               1 + spread_in_a_step(p) * (p->boxes_unit / 2)};
}

/* The sheet's active fibers, from those of the parts; good = steps that they are good for. */
static void parts_look(struct paper_sheet *p, const struct boxes_wish *wish, uint8_t *active)
{
    struct sheet_boxes *b = p->boxes;
    uint8_t *own = b->words;
    int distance = INT_MAX;
    for (int i = 0; i < PARTS_MOST; i++) {
        if (!b->parts[i] || !b->parts[i]->open)
            continue;
        const struct box *box = &b->parts[i]->box;
        b->parts[i]->sheet.air = p->air;
        b->parts[i]->sheet.salted = p->salted;
        active_read(&b->parts[i]->sheet, own);
        const int here = boxes_distance(wish, box, own);
        distance = here < distance ? here : distance;
        for (int y = 0; y < box->height; y++)
            for (int x = 0; x < box->width; x++)
                active[(size_t)((box->y + y) % wish->height) * (size_t)wish->width +
                       (size_t)((box->x + x) % wish->width)] =
                    own[(size_t)y * (size_t)box->width + (size_t)x];
    }
    b->good = distance == INT_MAX ? INT_MAX : (distance - 1) / spread_in_a_step(p);
}

static double boxes_area(const struct box *boxes, int count)
{
    double area = 0;
    for (int i = 0; i < count; i++)
        area += (double)boxes[i].width * boxes[i].height;
    return area;
}

static double parts_area(const struct sheet_boxes *b)
{
    double area = 0;
    for (int i = 0; i < PARTS_MOST; i++)
        if (b->parts[i] && b->parts[i]->open)
            area += (double)b->parts[i]->box.width * b->parts[i]->box.height;
    return area;
}

/* ---- cutting ---- */

static enum paper_status boxes_open(struct paper_sheet *p, const struct box *boxes, int count)
{
    struct sheet_boxes *b = p->boxes;
    struct part *parts[BOXES_MOST];
    size_t most = 1;
    enum paper_status status = PAPER_OK;
    for (int i = 0; i < count && status == PAPER_OK; i++) {
        const size_t words = (size_t)boxes[i].width * (size_t)boxes[i].height;
        most = words > most ? words : most;
        status = part_get(p, &boxes[i], &parts[i]);
    }
    parts_closed_few(p);
    free(b->words);
    b->words = malloc(most * sizeof(uint32_t));
    if (status == PAPER_OK && !b->words)
        status = paper_fail(PAPER_NO_MEMORY, "no memory for a part of a sheet");
    if (status != PAPER_OK) {
        parts_close(b);
        return status;
    }
    paper_enter(&p->page);
    for (int i = 0; i < count; i++)
        part_fill(p, parts[i], b->words);
    b->confined = true;
    b->ahead = false;
    b->air = p->air;
    b->good = count > 0 ? p->boxes_unit / 2 : INT_MAX;
    return paper_leave(&p->page);
}

/* Looks where it is wet, and cuts boxes if that is worth it. */
static enum paper_status boxes_cut(struct paper_sheet *p)
{
    struct sheet_boxes *b = p->boxes;
    const struct boxes_wish wish = wish_of(p);
    const double all = (double)wish.width * wish.height;
    struct box boxes[BOXES_MOST];
    uint8_t *active = calloc((size_t)wish.height, (size_t)wish.width);
    if (!active)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a sheet of %dx%d", wish.width,
                          wish.height);
    paper_enter(&p->page);
    if (b->confined)
        parts_look(p, &wish, active);
    else
        active_read(p, active);
    enum paper_status status = paper_leave(&p->page);
    const int count = boxes_find(&wish, active, boxes);
    free(active);
    if (status != PAPER_OK)
        return status;
    const double area = boxes_area(boxes, count);
    if (b->confined && b->good >= wish.unit / 4 && area > SHRUNK * parts_area(b))
        return PAPER_OK;
    const int wait_next = b->wait_next;
    sheet_change(p);
    status = paper_leave(&p->page);
    if (status != PAPER_OK || area <= SHARE_MOST * all)
        return status == PAPER_OK ? boxes_open(p, boxes, count) : status;
    b->wait = wait_next;
    b->wait_next = 2 * wait_next < WAIT_MOST ? 2 * wait_next : WAIT_MOST;
    return PAPER_OK;
}

/* ---- steps ---- */

void sheet_boxes_init(struct paper_sheet *p)
{
    p->boxes_unit = UNIT_USUAL;
}

static bool boxes_pay(const struct paper_sheet *p)
{
    const double unit = p->boxes_unit,
                 fibers = (double)p->page.grid.width * p->page.grid.height;
    return p->config.parts && sheet_flows(p) && unit > 0 && fibers >= SHEET_LEAST * unit * unit;
}

/* Whether this step can be done in boxes; they are opened or looked at where that is due. */
static enum paper_status confine(struct paper_sheet *p, bool *confined)
{
    struct sheet_boxes *b = p->boxes;
    enum paper_status status = PAPER_OK;
    *confined = false;
    if (!boxes_pay(p))
        return PAPER_OK;
    if (!b) {
        b = p->boxes = calloc(1, sizeof *b);
        if (!b)
            return paper_fail(PAPER_NO_MEMORY, "no memory for the parts of a sheet");
        b->wait_next = WAIT_LEAST;
    }
    if (b->confined && memcmp(&b->air, &p->air, sizeof b->air) != 0) {
        sheet_change(p);
        status = paper_leave(&p->page);
    }
    if (status == PAPER_OK && !b->confined && b->wait > 0)
        b->wait--;
    else if (status == PAPER_OK && (!b->confined || b->good < 1))
        status = boxes_cut(p);
    *confined = b->confined;
    return status;
}

enum paper_status sheet_step(struct paper_sheet *p, const void *arguments)
{
    bool confined;
    (void)arguments;
    p->steps++;
    enum paper_status status = confine(p, &confined);
    if (status != PAPER_OK)
        return status;
    struct sheet_boxes *b = p->boxes;
    if (b)
        b->share =
            confined ? parts_area(b) / ((double)p->page.grid.width * p->page.grid.height) : 1;
    paper_enter(&p->page);
    if (!confined)
        sheet_step_everywhere(p);
    for (int i = 0; i < PARTS_MOST && confined; i++) {
        if (!b->parts[i] || !b->parts[i]->open)
            continue;
        struct paper_sheet *s = &b->parts[i]->sheet;
        s->air = p->air;
        s->salted = p->salted;
        s->salt_reach = p->salt_reach;
        s->salt_strength = p->salt_strength;
        CM_set_vp_set(s->page.grid.vp_set);
        sheet_step_everywhere(s);
    }
    if (confined) {
        b->ahead = true;
        b->good -= b->good != INT_MAX;
    }
    return paper_leave(&p->page);
}

enum paper_status sheet_confine(struct paper_sheet *p, int unit)
{
    if (unit != 0 && (unit < 4 || unit > 4096))
        return paper_fail(PAPER_BAD_ARGUMENT,
                          "a box's sides are multiples of 4..4096 fibers (got %d)", unit);
    sheet_change(p);
    p->boxes_unit = unit;
    return paper_leave(&p->page);
}

double sheet_share(const struct paper_sheet *p)
{
    return p->boxes ? p->boxes->share : 1;
}
