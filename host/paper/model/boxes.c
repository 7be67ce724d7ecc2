/* boxes.c - a step costs what is wet, not what the sheet is: steps of water that flows are
 * computed in boxes around what can change.
 *
 * A fiber is at rest where there is no water, nothing flows, wet_around and brine are 0, and no
 * pigment in the fibers still settles. A fiber at rest among fibers at rest stays as it is, to
 * the bit: every flow has a factor that is 0. In a step activity spreads by one fiber, and by
 * as many as wet_around reaches.
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
 * So a step in boxes gives the same bits as one of the whole sheet. The boxes are good for as
 * many steps as what is active is away from their sides; then they are looked at again, and cut
 * anew where it has come too near or has shrunk. Whoever changes the sheet closes them. Where
 * more than three quarters would lie in boxes there are none, and the sheet is looked at again
 * some steps later. */
#include "model/boxes_parts.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    UNIT_USUAL = 64,
    REST_LEAST = 2 * SHEET_LOOK_REACH,
    SHEET_LEAST = 64, /* units x units: a step of less takes no longer than a box's beginning */
    WAIT_MOST = 384
};
#define SHRUNK 0.6        /* of their area, from which boxes are cut anew */
#define SETTLED_LEAST 4.5 /* grains that settle at 1 / 10 of the pace: fewer than a half stay */

/* ---- what is active ---- */

/* Fibers that a step's activity may spread by. */
static int spread_in_a_step(const struct paper_sheet *p)
{
    const int around = sheet_has(p, PAPER_PART_SURFACE) ? sheet_around_reach(p) : 1,
              creeps = sheet_capillary_passes(p);
    return around > creeps ? around : creeps;
}

/* Fibers that stay at rest along a box's sides: a picture looks over the first of them to the
 * next, and what salt does in a fiber depends on the heights of others, at rest or not. */
static int rest_of(const struct paper_sheet *p)
{
    const int salt = sheet_salt_reach(p);
    return salt > REST_LEAST ? salt : REST_LEAST;
}

static void mask_where(struct paper_sheet *p, CM_field_id_t d, unsigned why)
{
    CM_f_gt_constant_1L(d, 0.0, KIT_F);
    CM_logand_context_with_test();
    CM_u_move_constant_1L(p->mask, why, 8);
    CM_set_context();
}

/* mask = SHEET_ACTIVE_... where a fiber is not at rest, else 0. All that is added is 0 or more.
 * Uses t[0..2]. */
static void active_make(struct paper_sheet *p)
{
    CM_field_id_t sum = p->t[0], part = p->t[1], other = p->t[2];
    const bool surface = sheet_has(p, PAPER_PART_SURFACE);
    kit_f_copy(sum, p->page.water);
    if (surface) {
        kit_f_add(sum, sum, p->surface_water);
        kit_f_add(sum, sum, p->wet_part);
        sheet_paint_sum(
            p,
            /* what is stained has paint, and what has paint is stained: else a step changes
             * it */
            part);
        kit_f_most(part, part, 1.0);
        kit_f_times(other, p->stained, SHEET_STAINED_SCALE);
        kit_f_most(other, other, 1.0);
        kit_f_sub(part, part, other);
        kit_f_mul(part, part, part);
        kit_f_add(sum, sum, part);
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
    kit_f_copy(part, sum);
    if (surface)
        kit_f_add(part, part, p->wet_around);
    mask_where(p, part, SHEET_ACTIVE_AROUND);
    mask_where(p, sum, SHEET_ACTIVE_WET);
    kit_f_set(sum, 0.0);
    kit_f_set(part, 0.0);
    kit_f_set(other, 0.0);
}

static void active_read(struct paper_sheet *p, uint8_t *active)
{
    CM_set_vp_set(p->page.grid.vp_set);
    CM_set_context();
    active_make(p);
    kit_grid_u_read(&p->page.grid, active, p->mask, 8, CM_8_bit);
}

/* Steps for which boxes get a margin: fewer where wet_around reaches far, or they would be
 * large. */
static int steps_ahead(const struct paper_sheet *p)
{
    const int reach = spread_in_a_step(p), most = p->boxes_unit / 3,
              far = 3 * most / reach > 1 ? 3 * most / reach : 1;
    return far < most ? far : most;
}

static struct boxes_wish wish_of(const struct paper_sheet *p)
{
    return (struct boxes_wish){p->page.grid.width, p->page.grid.height, p->boxes_unit,
                               rest_of(p) + spread_in_a_step(p) * steps_ahead(p)};
}

/* Steps that boxes are good for whose sides are so far from what is active; INT_MAX: nothing
 * is. */
static int steps_good(const struct paper_sheet *p, int distance)
{
    const int rest = rest_of(p);
    return distance == INT_MAX ? INT_MAX
           : distance < rest   ? 0
                               : (distance - rest) / spread_in_a_step(p);
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
    b->good = steps_good(p, distance);
}

/* Steps for which active fibers there leave the part as it is: 0 where they are not in it. */
static int part_good_for(const struct paper_sheet *p, const struct part *part,
                         const struct box *at)
{
    const int sides[2][4] = {
        {at->x, at->width, part->box.x, part->box.width},
        {at->y, at->height, part->box.y, part->box.height},
    };
    const int lengths[2] = {p->page.grid.width, p->page.grid.height};
    int distance = INT_MAX;
    for (int i = 0; i < 2; i++) {
        const int before = ((sides[i][0] - sides[i][2]) % lengths[i] + lengths[i]) % lengths[i],
                  after = sides[i][3] - before - sides[i][1],
                  least = before < after ? before : after;
        if (sides[i][3] != lengths[i] && least < distance)
            distance = least;
    }
    return steps_good(p, distance);
}

/* The open part that these fibers are well within; NULL: there is none. */
static struct part *part_around(const struct paper_sheet *p, const struct box *at)
{
    for (int i = 0; i < PARTS_MOST; i++) {
        struct part *part = p->boxes->parts[i];
        if (part && part->open && part_good_for(p, part, at) > 0)
            return part;
    }
    return NULL;
}

static double boxes_area(const struct box *boxes, int count)
{
    double area = 0;
    for (int i = 0; i < count; i++)
        area += (double)boxes[i].width * boxes[i].height;
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
    b->good = count > 0 ? steps_ahead(p) : INT_MAX;
    return paper_leave(&p->page);
}

/* Fibers that will be touched are active, too. They need no margin until they are: only what is
 * so far within them is marked that the margin around it covers the rest for one step. */
static void expected_mark(const struct paper_sheet *p, const struct boxes_wish *wish,
                          uint8_t *active)
{
    const struct box *e = &p->boxes->expected;
    const int within = wish->margin - rest_of(p) - spread_in_a_step(p),
              side_x = within < (e->width - 1) / 2 ? within : (e->width - 1) / 2,
              side_y = within < (e->height - 1) / 2 ? within : (e->height - 1) / 2;
    if (e->width == 0)
        return;
    for (int y = e->y + side_y; y < e->y + e->height - side_y; y++)
        for (int x = e->x + side_x; x < e->x + e->width - side_x; x++)
            if (!active[(size_t)y * (size_t)wish->width + (size_t)x])
                active[(size_t)y * (size_t)wish->width + (size_t)x] = SHEET_ACTIVE_AROUND;
}

static void wet_find(struct paper_sheet *p, const uint8_t *active)
{
    for (int i = 0; i < PARTS_MOST; i++)
        if (p->boxes->parts[i] && p->boxes->parts[i]->open)
            part_wet_find(p, p->boxes->parts[i], active);
}

/* Whether the open boxes stay as they are, where those would be cut. */
static bool boxes_stay(const struct paper_sheet *p, double area)
{
    const struct sheet_boxes *b = p->boxes;
    return b->confined && b->good >= (steps_ahead(p) + 1) / 2 &&
           area > SHRUNK * parts_area(b) &&
           (b->expected.width == 0 || part_around(p, &b->expected));
}

/* Boxes around what is active, if that is worth it. */
static enum paper_status boxes_around(struct paper_sheet *p, const struct boxes_wish *wish,
                                      const uint8_t *active)
{
    struct sheet_boxes *b = p->boxes;
    struct box boxes[BOXES_MOST];
    const int count = boxes_find(wish, active, boxes), wait_next = b->wait_next;
    const double area = boxes_area(boxes, count), all = (double)wish->width * wish->height;
    if (boxes_stay(p, area))
        return PAPER_OK;
    parts_leave(p);
    const enum paper_status status = paper_leave(&p->page);
    if (status != PAPER_OK || area <= SHARE_MOST * all)
        return status == PAPER_OK ? boxes_open(p, boxes, count) : status;
    b->wait = wait_next;
    b->wait_next = 2 * wait_next < WAIT_MOST ? 2 * wait_next : WAIT_MOST;
    return PAPER_OK;
}

/* Looks where it is wet, and cuts boxes if that is worth it. */
static enum paper_status boxes_cut(struct paper_sheet *p)
{
    const struct boxes_wish wish = wish_of(p);
    uint8_t *active = calloc((size_t)wish.height, (size_t)wish.width);
    if (!active)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a sheet of %dx%d", wish.width,
                          wish.height);
    paper_enter(&p->page);
    if (p->boxes->confined)
        parts_look(p, &wish, active);
    else
        active_read(p, active);
    enum paper_status status = paper_leave(&p->page);
    if (status == PAPER_OK) {
        expected_mark(p, &wish, active);
        status = boxes_around(p, &wish, active);
        wet_find(p, active);
    }
    free(active);
    return status;
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
    return p->config.parts && unit > 0 && fibers >= SHEET_LEAST * unit * unit;
}

static enum paper_status boxes_ready(struct paper_sheet *p)
{
    if (p->boxes)
        return PAPER_OK;
    p->boxes = calloc(1, sizeof *p->boxes);
    if (!p->boxes)
        return paper_fail(PAPER_NO_MEMORY, "no memory for the parts of a sheet");
    p->boxes->wait_next = WAIT_LEAST;
    return PAPER_OK;
}

/* Whether this step can be done in boxes; they are opened or looked at where that is due. */
static enum paper_status confine(struct paper_sheet *p, bool *confined)
{
    *confined = false;
    if (!boxes_pay(p))
        return PAPER_OK;
    enum paper_status status = boxes_ready(p);
    struct sheet_boxes *b = p->boxes;
    if (status != PAPER_OK)
        return status;
    if (b->confined && memcmp(&b->air, &p->air, sizeof b->air) != 0) {
        parts_leave(p);
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
    if (!confined) {
        sheet_area_mark_all(p);
        sheet_step_everywhere(p);
    }
    for (int i = 0; i < PARTS_MOST && confined; i++) {
        if (!b->parts[i] || !b->parts[i]->open)
            continue;
        struct paper_sheet *s = &b->parts[i]->sheet;
        s->air = p->air;
        s->salted = p->salted;
        s->parted_from = p->parted_from;
        s->salt_reach = p->salt_reach;
        s->salt_strength = p->salt_strength;
        CM_set_vp_set(s->page.grid.vp_set);
        sheet_step_everywhere(s);
        struct box changed;
        part_changed(b->parts[i], &changed);
        sheet_area_mark(p, changed.x, changed.y, changed.width, changed.height);
        const struct box *box = &b->parts[i]->box;
        sheet_area_touch(p, box->x, box->y, box->width, box->height);
    }
    if (confined) {
        b->ahead = true;
        b->good -= b->good != INT_MAX;
    }
    return paper_leave(&p->page);
}

enum paper_status sheet_boxes_finish(struct paper_sheet *p)
{
    const struct sheet_boxes *b = p->boxes;
    return b && b->confined && b->good < 1 ? boxes_cut(p) : PAPER_OK;
}

/* ---- strokes ---- */

enum paper_status sheet_boxes_expect(struct paper_sheet *p, int x1, int y1, int x2, int y2)
{
    const int width = p->page.grid.width, height = p->page.grid.height;
    x1 = x1 > 0 ? x1 : 0;
    y1 = y1 > 0 ? y1 : 0;
    x2 = x2 < width ? x2 : width;
    y2 = y2 < height ? y2 : height;
    if (!boxes_pay(p))
        return PAPER_OK;
    enum paper_status status = boxes_ready(p);
    if (status != PAPER_OK)
        return status;
    struct sheet_boxes *b = p->boxes;
    b->expected = (struct box){0, 0, 0, 0};
    if (x1 >= x2 || y1 >= y2)
        return PAPER_OK;
    b->expected = (struct box){x1, y1, x2 - x1, y2 - y1};
    return b->confined ? part_around(p, &b->expected) ? PAPER_OK : boxes_cut(p)
           : b->wait ? PAPER_OK
                       : boxes_cut(p);
}

struct paper_sheet *sheet_boxes_touch(struct paper_sheet *p, int x1, int y1, int x2, int y2,
                                      int origin[2])
{
    struct sheet_boxes *b = p->boxes;
    const struct box at = {x1, y1, x2 - x1, y2 - y1};
    origin[0] = origin[1] = 0;
    sheet_area_change(p, x1, y1, x2 - x1, y2 - y1);
    if (!b || !b->confined)
        return p;
    struct part *part = part_around(p, &at);
    if (!part) {
        parts_give(p);
        parts_close(b);
        CM_set_vp_set(p->page.grid.vp_set);
        return p;
    }
    const int good = part_good_for(p, part, &at);
    part_wet_add(p, part, &at);
    b->good = good < b->good ? good : b->good;
    b->ahead = true;
    origin[0] = part->box.x;
    origin[1] = part->box.y;
    return &part->sheet;
}

enum paper_status sheet_confine(struct paper_sheet *p, int unit)
{
    if (unit != 0 && (unit < 4 || unit > 4096))
        return paper_fail(PAPER_BAD_ARGUMENT,
                          "a box's sides are multiples of 4..4096 fibers (got %d)", unit);
    parts_leave(p);
    p->boxes_unit = unit;
    return paper_leave(&p->page);
}

double sheet_share(const struct paper_sheet *p)
{
    return p->boxes ? p->boxes->share : 1;
}
