/* stroke.c - where the bristles are: the tuft, and its way over the paper.
 *
 *            width                     across: -1..1 from left to right, along: -1..1 from heel
 *                                      to toe
 *        .-----------.
 *       (  . . . . .  )  depth         pressure p presses bristle i down by p (1 + tilt) - shorter[i]; it touches
 *        '-----------'                 where that is above 0, and its force is that over
 *                                      FORCE_FULL, at most 1
 *
 * While a step of the paper lasts the tuft goes some way; each bristle touches the fibers along
 * it at even distances, at most BRUSH_ROWS in one exchange. Which fibers a place lies over, and
 * which it talks to, says touches.c. A place lasts as long as the bristle's thickness takes to
 * pass; contact = 1 - exp (-flow * that). Places lie evenly in a line as wide as the bristle is
 * thick, which follows from the bristle and the number of the place alone. */
#include "model/brush_internal.h"
#include "model/clouds.h"

#include <math.h>
#include <string.h>

#define PLACE_SPACING 0.35 /* fibers, along a bristle's way */
#define FORCE_FULL 0.3
/* How wide a line is at least, of a bristle's share of the tuft's width. */
#define LINES_OVERLAP 5.0
#define HAIRS_STEPS 4.0   /* of a fiber: where strokes begin, for their hairs */
#define WAITING_PACE 60.0 /* pieces of a second where the paper waits */
#define TOUCH_SHARE 0.15  /* of a bristle's contact: fibers are touched by several */
/* On the scale of heights: at full force a dry bristle touches the fibers whose tooth is above
 * 1/2 - DRY_REACH. A tuft feels the tooth so many times: it has less of the heights' deviation
 * than the heights. */
#define DRY_REACH 0.55
#define TOOTH_FELT 1.8
/* The tooth's deviation at which hairs lift in full. On smoother paper they lift less, in
 * proportion: with the same lifting everywhere they left streaks there, and not the tooth. */
#define LIFT_TOOTH 0.25
/* A bristle's share of a tuft that stands, as a disc's radius, to that of discs that fill it;
 * places in it for each fiber; and how often bristles are exchanged for that, at most. */
#define SHARES_OVERLAP 1.7
#define PLACES_WITHIN 1.5
#define RESTS_MOST 32
#define TURN 6.283185307179586
#define GOLDEN_ANGLE 2.3999632297286533
#define CONTACT_STEPS                                                                          \
    65536.0 /* a contact is a whole number of these: the last bits of exp() vary */

/* The tuft at one moment of a stroke. */
struct tuft {
    double x, y;                /* its middle, where it is pressed */
    double across[2], along[2]; /* the tuft's axes, half its size long */
    double half[2];             /* their lengths */
    double pressure, lean[2];   /* lean: how much harder one side is pressed, along both axes */
};

static struct tuft tuft_make(const struct sheet_brush *own,
                             const struct paper_stroke_sample *at)
{
    const struct paper_brush *brush = &own->brush;
    double c = cos(brush->angle), s = sin(brush->angle), axis[2] = {c, s};
    if (brush->follows) { /* across is the stroke's normal, to the right of where it goes */
        axis[0] = -own->toward[1] * c - own->toward[0] * s;
        axis[1] = own->toward[0] * c - own->toward[1] * s;
    }
    /* the tips of a pointed brush gather where it is lifted */
    double spread =
        (1 - 0.5 * brush->point * (1 - at->pressure)) * (1 + brush->splay * at->pressure) / 2;
    double trail = -brush->bend * at->pressure * brush->width / 2;
    struct tuft tuft = {.pressure = at->pressure};
    double tilt[2] = {sin(at->tilt_x), sin(at->tilt_y)};
    tuft.x = at->x + trail * own->toward[0] + tilt[0] * brush->width * at->pressure / 2;
    tuft.y = at->y + trail * own->toward[1] + tilt[1] * brush->width * at->pressure / 2;
    tuft.across[0] = axis[0] * spread * brush->width;
    tuft.across[1] = axis[1] * spread * brush->width;
    tuft.along[0] = axis[1] * spread * brush->depth;
    tuft.along[1] = -axis[0] * spread * brush->depth;
    tuft.half[0] = hypot(tuft.across[0], tuft.across[1]);
    tuft.half[1] = hypot(tuft.along[0], tuft.along[1]);
    tuft.lean[0] = axis[0] * tilt[0] + axis[1] * tilt[1];
    tuft.lean[1] = axis[1] * tilt[0] - axis[0] * tilt[1];
    return tuft;
}

static double spacing_of(const struct paper_sheet *p)
{
    return PLACE_SPACING / p->finer;
}

/* Where a place lies beside where its bristle is, in fibers along the tuft's axes. */
struct beside {
    double side, ahead;
};

/* Places that lie evenly on a line as wide as the bristle, however many of them there are:
 * multiples of the golden section, counted from a place of the bristle's own. */
static struct beside place_beside(const struct sheet_going *g, int number)
{
    const struct paper_brush *brush = &g->own->brush;
    double from = sheet_chance(brush->seed + 7, (uint64_t)number, 0),
           along = sheet_chance(brush->seed + 7, (uint64_t)number, 1);
    double place = from + 0.6180339887498949 * (double)g->moment,
           forward = along + 0.7548776662466927 * (double)g->moment;
    place -= floor(place);
    forward -= floor(forward);
    const double width =
        fmin(brush->thickness,
             fmax(g->sheet->finer, LINES_OVERLAP * brush->width / brush->bristles));
    return (struct beside){width * (place - 0.5), spacing_of(g->sheet) * (forward - 0.5)};
}

/* One place of bristle `number`; false: it does not touch. */
static bool place_make(const struct sheet_going *g, const struct tuft *tuft, int number,
                       const struct sheet_hair *hair, struct beside beside,
                       struct sheet_place *place, double *force)
{
    const struct paper_sheet *p = g->sheet;
    const struct sheet_brush *own = g->own;
    const struct sheet_bristle *bristle = &own->bristles[number];
    const int turned = own->brush.mirrored ? -1 : 1;
    double across = bristle->across * turned, along = bristle->along;
    double pressed = tuft->pressure * (1 + tuft->lean[0] * across + tuft->lean[1] * along) -
                     bristle->shorter;
    if (!(pressed > 0))
        return false;
    *force = fmin(1, pressed / FORCE_FULL);
    double at[2];
    const double side = (beside.side + hair->aside) * turned;
    for (int i = 0; i < 2; i++)
        at[i] = (i == 0 ? tuft->x : tuft->y) +
                tuft->across[i] * (across + side / tuft->half[0]) +
                tuft->along[i] * (along + beside.ahead / tuft->half[1]);
    return sheet_place_make(p, at[0], at[1], *force, hair->lifted, place);
}

static float whole_contact(double contact)
{
    return (float)(rint(contact * CONTACT_STEPS) / CONTACT_STEPS);
}

/* What all touches of a fiber in one exchange come to, of the way to equal levels. It is the
 * same whether they come in one exchange or in two, so there are no bars where one ends and the
 * next begins. */
static double contact_of(const struct sheet_brush *own, double dwell, double touches)
{
    return 1 - exp(-TOUCH_SHARE * own->brush.flow * dwell * touches);
}

/* Where the fibers (those of 0 or more, by row-major number on the sheet) are on the sheet or
 * on a box of it, which is returned. */
static struct paper_sheet *addresses_make(struct paper_sheet *p, const int fibers[BRUSH_PLACES],
                                          uint32_t address[BRUSH_PLACES])
{
    const int width = p->page.grid.width, height = p->page.grid.height;
    int x1 = width, y1 = height, x2 = 0, y2 = 0, origin[2];
    for (int i = 0; i < BRUSH_PLACES; i++) {
        if (fibers[i] < 0)
            continue;
        const int x = fibers[i] % width, y = fibers[i] / width;
        x1 = x < x1 ? x : x1;
        y1 = y < y1 ? y : y1;
        x2 = x >= x2 ? x + 1 : x2;
        y2 = y >= y2 ? y + 1 : y2;
    }
    struct paper_sheet *at = sheet_boxes_touch(p, x1, y1, x2, y2, origin);
    const CM_geometry_id_t geometry = at->page.grid.geometry;
    for (int i = 0; i < BRUSH_PLACES; i++) {
        if (fibers[i] < 0)
            continue;
        const int x = (fibers[i] % width - origin[0] + width) % width,
                  y = (fibers[i] / width - origin[1] + height) % height;
        address[i] = CM_fe_deposit_news_coordinate(
            geometry, CM_fe_make_news_coordinate(geometry, KIT_AXIS_Y, (unsigned)y), KIT_AXIS_X,
            (unsigned)x);
    }
    return at;
}

/* The tuft at a time; the stroke's direction there is kept. */
static struct tuft tuft_at(struct sheet_going *g, double time, double length)
{
    struct paper_stroke_sample at = paper_stroke_at(g->stroke, time, &g->cursor);
    struct paper_stroke_sample next =
        paper_stroke_at(g->stroke, time + fmax(length, 1e-6), &g->cursor);
    double dx = next.x - at.x, dy = next.y - at.y, distance = hypot(dx, dy);
    if (distance > 1e-9) {
        g->own->toward[0] = dx / distance;
        g->own->toward[1] = dy / distance;
    }
    return tuft_make(g->own, &at);
}

/* In how many places each bristle touches. */
static void places_count(struct sheet_contacts *c, int rows, int bristles)
{
    for (int i = 0; i < BRUSH_PLACES; i++)
        c->places[i] = 1;
    for (int i = 0; i < bristles; i++) {
        int places = 0;
        for (int row = 0; row < rows; row++)
            places += c->contact[row * PAPER_BRISTLES_MAX + i] > 0;
        for (int row = 0; row < rows; row++)
            c->places[row * PAPER_BRISTLES_MAX + i] = (float)(places > 0 ? places : 1);
    }
}

/* How far below a fiber a dry bristle reaches, pressed with that force. */
static float reach_of(const struct paper_sheet *p, int fiber, double force)
{
    return (float)(TOOTH_FELT * sheet_tooth_at(p, fiber) - 0.5) +
           (float)DRY_REACH * whole_contact(force);
}

/* Each bristle's hair now, and after so many places. */
static void hairs_make(const struct sheet_going *g, int rows,
                       struct sheet_hair hairs[2][PAPER_BRISTLES_MAX])
{
    const double finer = g->sheet->finer;
    for (int end = 0; end < 2; end++)
        for (int i = 0; i < g->own->brush.bristles; i++)
            hairs[end][i] =
                sheet_hair_at(g->own, i, g->seed, g->way + end * rows * g->stride, finer);
}

static struct sheet_hair hair_between(const struct sheet_hair *from,
                                      const struct sheet_hair *to, double part)
{
    return (struct sheet_hair){from->aside + part * (to->aside - from->aside),
                               from->lifted + part * (to->lifted - from->lifted)};
}

static struct sheet_place places[BRUSH_PLACES]; /* of an exchange */

/* Fills p->brushes->contacts from places of which some touch. The sheet, or a box of it, that
 * the addresses are of. */
static struct paper_sheet *contacts_deal(struct sheet_going *g, double dwell, int rows)
{
    static struct sheet_dealt dealt;
    struct paper_sheet *p = g->sheet;
    struct sheet_contacts *c = &p->brushes->contacts;
    places_count(c, rows, g->own->brush.bristles);
    sheet_places_deal(p->brushes, places, &dealt);
    for (int i = 0; i < BRUSH_PLACES; i++) {
        c->contact[i] = 0;
        if (dealt.fibers[i] < 0)
            continue;
        c->contact[i] = whole_contact(contact_of(g->own, dwell, dealt.touch[i]));
        c->reach[i] = reach_of(p, dealt.fibers[i], dealt.force[i]);
    }
    return addresses_make(p, dealt.fibers, c->address);
}

static void places_begin(struct sheet_going *g)
{
    memset(&g->sheet->brushes->contacts, 0, sizeof g->sheet->brushes->contacts);
    memset(places, 0, sizeof places);
}

/* A place in a row; false: it does not touch. */
static bool place_add(const struct sheet_going *g, const struct tuft *tuft, int row,
                      int bristle, const struct sheet_hair *hair, struct beside beside,
                      double part)
{
    const int number = row * PAPER_BRISTLES_MAX + bristle;
    double force;
    if (!place_make(g, tuft, bristle, hair, beside, &places[number], &force))
        return false;
    const float contact = whole_contact(part * force);
    if (!(contact > 0))
        places[number].force = 0;
    g->sheet->brushes->contacts.contact[number] = contact;
    return contact > 0;
}

/* The touches at the times from..from + rows * length. The sheet, or a box of it, on which they
 * are; NULL: nothing touches. */
static struct paper_sheet *contacts_make(struct sheet_going *g, double from, double length,
                                         int rows, double dwell)
{
    static struct sheet_hair hairs[2][PAPER_BRISTLES_MAX];
    const double part = 1 - exp(-g->own->brush.flow * dwell),
                 lift = fmin(1, g->sheet->tooth_deviation / LIFT_TOOTH);
    bool touching = false;
    places_begin(g);
    hairs_make(g, rows, hairs);
    for (int row = 0; row < rows; row++, g->moment++, g->way += g->stride) {
        struct tuft tuft = tuft_at(g, from + (row + 0.5) * length, length);
        for (int i = 0; i < g->own->brush.bristles; i++) {
            struct sheet_hair hair =
                hair_between(&hairs[0][i], &hairs[1][i], (row + 0.5) / rows);
            hair.lifted *= lift;
            touching |= place_add(g, &tuft, row, i, &hair, place_beside(g, i), part);
        }
    }
    return touching ? contacts_deal(g, dwell, rows) : NULL;
}

static void exchange(const struct sheet_going *g, struct paper_sheet *at)
{
    sheet_brush_exchange(at, g->sheet->brushes, g->own);
    g->sheet->exchanges++;
}

/* ---- where a stroke begins and ends ---- */

/* The place `count` of so many in a bristle's share of the tuft: they lie evenly on a disc. */
static struct beside place_within(const struct sheet_going *g, int bristle, int count, int many,
                                  double share)
{
    const double turn = TURN * sheet_chance(g->own->brush.seed + 8, (uint64_t)bristle, 0),
                 out = share * sqrt((count + 0.5) / many), angle = GOLDEN_ANGLE * count + turn;
    return (struct beside){out * cos(angle), out * sin(angle)};
}

static bool under_tuft(const struct sheet_brush *own, int bristle, const struct tuft *tuft,
                       struct beside beside)
{
    const double across = own->bristles[bristle].across + beside.side / tuft->half[0],
                 along = own->bristles[bristle].along + beside.ahead / tuft->half[1];
    return own->brush.flat ? fabs(across) <= 1 && fabs(along) <= 1
                           : across * across + along * along <= 1;
}

/* The tuft stands on the paper for a moment. What its hairs hold stands between them, too, so
 * all that lies under the tuft is touched: each hair touches its share of it. (Without this a
 * stroke of a wet mop began and ended in combs, where single hairs were set down and lifted.)
 * It is touched as much as half of the tuft does that passes in the same way. */
static void tuft_rest(struct sheet_going *g, double time, double dwell)
{
    static struct sheet_hair hairs[2][PAPER_BRISTLES_MAX];
    const struct paper_brush *brush = &g->own->brush;
    const double finer = g->sheet->finer,
                 lift = fmin(1, g->sheet->tooth_deviation / LIFT_TOOTH);
    const struct tuft tuft = tuft_at(g, time, 0);
    const double share = SHARES_OVERLAP * sqrt(tuft.half[0] * tuft.half[1] / brush->bristles);
    const double area = TURN / 2 * share * share;
    const int times = (int)fmin(RESTS_MOST, fmax(1, ceil(area * PLACES_WITHIN / BRUSH_ROWS)));
    const double moment = dwell * finer * TURN / 2 * tuft.half[1] /
                          (4 * PLACE_SPACING * BRUSH_ROWS * times),
                 part = 1 - exp(-brush->flow * moment);
    hairs_make(g, 0, hairs);
    for (int done = 0; done < times; done++) {
        if (g->sheet->due && g->sheet->due(g->sheet->due_context))
            return;
        bool touching = false;
        places_begin(g);
        for (int row = 0; row < BRUSH_ROWS; row++)
            for (int i = 0; i < brush->bristles; i++) {
                struct sheet_hair hair = hairs[0][i];
                hair.lifted *= lift;
                const struct beside beside =
                    place_within(g, i, row * times + done, BRUSH_ROWS * times, share);
                touching |= under_tuft(g->own, i, &tuft, beside) &&
                            place_add(g, &tuft, row, i, &hair, beside, part);
            }
        if (touching)
            exchange(g, contacts_deal(g, moment, BRUSH_ROWS));
    }
}

/* ---- on its way ---- */

/* How far the stroke goes from..to. */
static double way_length(struct sheet_going *g, double from, double to)
{
    enum { CHORDS = 6 };
    double sum = 0;
    struct paper_stroke_sample before = paper_stroke_at(g->stroke, from, &g->cursor);
    for (int i = 1; i <= CHORDS; i++) {
        struct paper_stroke_sample at =
            paper_stroke_at(g->stroke, from + (to - from) * i / CHORDS, &g->cursor);
        sum += hypot(at.x - before.x, at.y - before.y);
        before = at;
    }
    return sum;
}

/* first, last: it is the stroke's first interval, its last. */
static void brush_go(struct sheet_going *g, double from, double to, bool first, bool last)
{
    double length = way_length(g, from, to), seconds = to - from;
    /* finer fibers are touched as often each as coarse ones */
    int count = (int)fmin(100000, fmax(1, ceil(length / spacing_of(g->sheet))));
    double thick = fmax(spacing_of(g->sheet), g->own->brush.thickness);
    double dwell = length > thick ? seconds * thick / length : seconds;
    g->stride = length / count;
    if (first)
        tuft_rest(g, from, dwell);
    for (int done = 0; done < count;) {
        if (g->sheet->due && g->sheet->due(g->sheet->due_context))
            return;
        const int rows = count - done < BRUSH_ROWS ? count - done : BRUSH_ROWS;
        struct paper_sheet *at =
            contacts_make(g, from + done * seconds / count, seconds / count, rows, dwell);
        if (at)
            exchange(g, at);
        done += rows;
    }
    if (last)
        tuft_rest(g, to, dwell);
}

static double stroke_start(const struct paper_stroke *stroke)
{
    return stroke->samples[0].time_s;
}

static double stroke_end(const struct paper_stroke *stroke)
{
    return stroke->samples[stroke->samples_count - 1].time_s;
}

static double stroke_pace(const struct paper_stroke *stroke)
{
    return stroke->pace > 0 ? stroke->pace : WAITING_PACE;
}

enum paper_status sheet_stroke_check(const struct paper_sheet *p, const void *arguments)
{
    (void)p;
    const struct paper_stroke *stroke = arguments;
    enum paper_status status = sheet_brush_number_check(stroke->number);
    if (status == PAPER_OK)
        status = paper_stroke_check(stroke);
    if (status != PAPER_OK)
        return status;
    double seconds = stroke_end(stroke) - stroke_start(stroke), pace = stroke_pace(stroke);
    return seconds * pace <= PAPER_STROKE_STEPS_MAX
               ? PAPER_OK
               : paper_fail(PAPER_BAD_ARGUMENT,
                            "a stroke takes at most %d steps (got %g seconds of %g each)",
                            PAPER_STROKE_STEPS_MAX, seconds, pace);
}

double sheet_stroke_around(const struct paper_sheet *p, const struct paper_brush *brush)
{
    return fmin(p->page.grid.width + p->page.grid.height,
                hypot(brush->width, brush->depth) * (1 + brush->splay + brush->bend) +
                    brush->thickness + 2);
}

/* Boxes get room for about all that a stroke touches while steps go. */
static enum paper_status stroke_expect(struct paper_sheet *p, const struct paper_stroke *stroke,
                                       const struct paper_brush *brush)
{
    const double most = p->page.grid.width + p->page.grid.height,
                 around = sheet_stroke_around(p, brush);
    double low[2] = {most, most}, high[2] = {-most, -most};
    for (int i = 0; i < stroke->samples_count; i++) {
        const double at[2] = {stroke->samples[i].x, stroke->samples[i].y};
        for (int axis = 0; axis < 2; axis++) {
            low[axis] = fmax(-most, fmin(low[axis], at[axis] - around));
            high[axis] = fmin(2 * most, fmax(high[axis], at[axis] + around));
        }
    }
    return sheet_boxes_expect(p, (int)low[0], (int)low[1], (int)high[0], (int)high[1]);
}

/* Strokes that begin at different places part their hairs otherwise. Where a stroke begins is
 * counted from the sheet's middle, in the stock's fibers: the same in a mirror and in a
 * render. */
static uint64_t hairs_seed(const struct sheet_going *g)
{
    const struct paper_sheet *p = g->sheet;
    const struct paper_stroke_sample *first = g->stroke->samples;
    const double x = fabs(first->x - p->page.grid.width / 2.0) / p->finer,
                 y = fabs(first->y - p->page.grid.height / 2.0) / p->finer;
    return clouds_word(clouds_word(g->own->brush.seed, (uint64_t)(HAIRS_STEPS * fmin(x, y))),
                       (uint64_t)(HAIRS_STEPS * fmax(x, y)));
}

void sheet_going_begin(struct sheet_going *g, struct paper_sheet *p,
                       const struct paper_stroke *stroke)
{
    *g = (struct sheet_going){
        .sheet = p, .own = &p->brushes->brush[stroke->number], .stroke = stroke};
    g->own->toward[0] = 1; /* where it goes is known as soon as it does */
    g->own->toward[1] = 0;
}

int sheet_going_intervals(const struct paper_stroke *stroke)
{
    const double seconds = stroke_end(stroke) - stroke_start(stroke);
    return (int)fmax(1, ceil(seconds * stroke_pace(stroke) - 1e-9));
}

int sheet_going_settled(const struct paper_stroke *stroke)
{
    /* a tuft looks up to half an interval ahead (tuft_at()); the spline before a sample is
     * settled by the next one */
    if (stroke->samples_count < 2)
        return 0;
    const double until = stroke->samples[stroke->samples_count - 2].time_s - 2e-6;
    const double intervals = (until - stroke_start(stroke)) * stroke_pace(stroke) - 0.5;
    return intervals > 0 ? (int)floor(intervals) : 0;
}

enum paper_status sheet_going_on(struct sheet_going *g, int until)
{
    struct paper_sheet *p = g->sheet;
    const double start = stroke_start(g->stroke), pace = stroke_pace(g->stroke);
    enum paper_status status = PAPER_OK;
    if (g->interval == 0 && until > 0)
        g->seed = hairs_seed(g);
    for (; g->interval < until && status == PAPER_OK; g->interval++) {
        if (p->due && p->due(p->due_context)) {
            /* half a stroke is no operation: it is as if it had not been begun */
            if (p->history)
                return paper_fail(PAPER_MACHINE_FAILED, "stopped");
            break;
        }
        const double end = stroke_end(g->stroke), from = start + g->interval / pace,
                     to = fmin(end, start + (g->interval + 1) / pace);
        const bool last = g->interval == sheet_going_intervals(g->stroke) - 1;
        paper_enter(&p->page);
        status = sheet_tooth_make(p);
        if (status != PAPER_OK) {
            paper_leave(&p->page);
            break;
        }
        brush_go(g, from, last && to <= from ? from + 1 / pace : fmax(to, from),
                 g->interval == 0, last);
        status = paper_leave(&p->page);
        if (g->stroke->pace > 0 && status == PAPER_OK) {
            status = sheet_step(p, NULL);
            if (status == PAPER_OK)
                status = sheet_finish(p);
        }
    }
    if (status == PAPER_OK && p->history && p->due && p->due(p->due_context))
        return paper_fail(PAPER_MACHINE_FAILED,
                          "stopped"); /* it may have ended in its last step */
    return status;
}

enum paper_status sheet_stroke(struct paper_sheet *p, const void *arguments)
{
    const struct paper_stroke *stroke = arguments;
    if (!sheet_brush_get(p, stroke->number))
        return paper_fail(PAPER_BAD_ARGUMENT, "the sheet has no brush %d", stroke->number);
    enum paper_status status = PAPER_OK;
    if (stroke->pace > 0)
        status = stroke_expect(p, stroke, &p->brushes->brush[stroke->number].brush);
    struct sheet_going g;
    sheet_going_begin(&g, p, stroke);
    if (status == PAPER_OK)
        status = sheet_going_on(&g, sheet_going_intervals(stroke));
    const enum paper_status ended = sheet_boxes_expect(p, 0, 0, 0, 0);
    return status == PAPER_OK ? ended : status;
}
