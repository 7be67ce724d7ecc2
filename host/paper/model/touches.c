/* touches.c - which fiber each bristle's place touches, and how much of each fiber is touched.
 *
 * A place is as large as a fiber and lies over up to four of them, as a pixel of type does:
 *
 *         +------+------+      a fiber's touch is the sum, over all places of an exchange, of
 *                              the part of the place
 *         |   .--|---.  |      that lies over it, times its force: even inside a stroke, less and less towards its
 *         +---|--+---|--+      edge
 *         |   '--|---'  |
 *         +------+------+
 *
 * But a place has one processor, which talks to one fiber. So each place takes that one of its
 * four which nobody has taken yet and of which it and others have most, else that which has
 * most left when what has been dealt out is taken off: so all fibers that are touched are
 * taken, where there are places enough, and each gets its own sum from those who took it. The
 * nearest fiber for each place left holes in a stroke, in rows along it.
 *
 * Parts are whole numbers, so sums are the same in any order, and a mirrored stroke deals
 * mirrored fibers out. */
#include "model/brush_internal.h"

#include <math.h>

enum { CORNERS = 4, PART_ONE = 1 << 12, FORCE_ONE = 1 << 16, FORCE_STEP = 1 << 8 };
#define PLACE_ONE ((double)PART_ONE * PART_ONE * FORCE_ONE)

/* A fiber over which places lie. */
struct touched {
    int fiber;
    int64_t sum, left;
    int64_t pressed; /* by force times what is held of it */
};

static struct touched found[CORNERS * BRUSH_PLACES];

int sheet_fiber_at(double at, int length, bool torus)
{
    double place = floor(at);
    if (torus)
        place -= length * floor(place / length);
    return place >= 0 && place < length ? (int)place : -1;
}

/* Of the place around x, y. False: it is beyond the sheet. */
static bool corners_make(const struct paper_sheet *p, double x, double y,
                         struct sheet_place *place)
{
    const double left = floor(x - 0.5), top = floor(y - 0.5);
    const int along_x = (int)rint((x - 0.5 - left) * PART_ONE),
              along_y = (int)rint((y - 0.5 - top) * PART_ONE);
    bool any = false;
    for (int i = 0; i < CORNERS; i++) {
        const int column = sheet_fiber_at(left + i % 2, p->page.grid.width, p->config.torus),
                  row = sheet_fiber_at(top + i / 2, p->page.grid.height, p->config.torus);
        place->part[i] =
            (i % 2 ? along_x : PART_ONE - along_x) * (i / 2 ? along_y : PART_ONE - along_y);
        if (column < 0 || row < 0)
            place->part[i] = 0;
        place->fiber[i] = place->part[i] > 0 ? row * p->page.grid.width + column : 0;
        any = any || place->part[i] > 0;
    }
    return any;
}

bool sheet_place_make(const struct paper_sheet *p, double x, double y, double force,
                      double lifted, struct sheet_place *place)
{
    const double most = 1e6; /* far beyond any sheet */
    if (!(fabs(x) < most && fabs(y) < most) || !corners_make(p, x, y, place))
        return false;
    place->force = (int)rint(force * FORCE_ONE);
    place->held = (int)rint((force - lifted) * FORCE_ONE);
    return true;
}

/* The corner that the place takes. */
static int corner_of(const struct sheet_place *place, const uint16_t *number,
                     const uint16_t *takers)
{
    int best = -1;
    for (int i = 0; i < CORNERS; i++) {
        if (place->part[i] == 0)
            continue;
        if (best < 0) {
            best = i;
            continue;
        }
        const int here = number[place->fiber[i]] - 1, there = number[place->fiber[best]] - 1;
        if ((takers[here] == 0) != (takers[there] == 0) ? takers[here] == 0
                                                        : found[here].left > found[there].left)
            best = i;
    }
    return best;
}

/* pressed * FORCE_STEP / sum, whose product may be too large; a sum is some 2^54 at most. */
static int64_t step_times(int64_t pressed, int64_t sum)
{
    return pressed / sum * FORCE_STEP + pressed % sum * FORCE_STEP / sum;
}

void sheet_places_deal(struct sheet_brushes *b, const struct sheet_place *places,
                       struct sheet_dealt *dealt)
{
    int *const fibers = dealt->fibers;
    static uint16_t takers[CORNERS * BRUSH_PLACES], taken[BRUSH_PLACES];
    uint16_t *number = b->touched; /* 1 + where the fiber is in found[] */
    int count = 0;
    for (int i = 0; i < BRUSH_PLACES; i++)
        for (int k = 0; k < CORNERS && places[i].force > 0; k++) {
            if (places[i].part[k] == 0)
                continue;
            const int fiber = places[i].fiber[k];
            if (number[fiber] == 0) {
                found[count] = (struct touched){.fiber = fiber};
                takers[count] = 0;
                number[fiber] = (uint16_t)(++count);
            }
            struct touched *t = &found[number[fiber] - 1];
            t->sum += (int64_t)places[i].part[k] * places[i].force;
            t->left = t->sum;
            t->pressed +=
                (int64_t)places[i].part[k] * places[i].force * (places[i].held / FORCE_STEP);
        }
    for (int i = 0; i < BRUSH_PLACES; i++) {
        fibers[i] = -1;
        if (places[i].force <= 0)
            continue;
        fibers[i] = places[i].fiber[corner_of(&places[i], number, takers)];
        taken[i] = (uint16_t)(number[fibers[i]] - 1);
        takers[taken[i]]++;
        found[taken[i]].left -= (int64_t)PART_ONE * PART_ONE * places[i].force;
    }
    for (int i = 0; i < BRUSH_PLACES; i++) {
        if (fibers[i] < 0 || takers[taken[i]] < 2)
            continue;
        const int corner = corner_of(&places[i], number, takers),
                  fiber = places[i].fiber[corner], other = number[fiber] - 1;
        if (takers[other] > 0)
            continue;
        takers[taken[i]]--;
        takers[other]++;
        taken[i] = (uint16_t)other;
        fibers[i] = fiber;
    }
    for (int i = 0; i < BRUSH_PLACES; i++) {
        const struct touched *t = &found[fibers[i] >= 0 ? taken[i] : 0];
        b->contacts.sharers[i] = fibers[i] >= 0 ? (float)takers[taken[i]] : 1;
        dealt->touch[i] = fibers[i] >= 0 ? (double)t->sum / PLACE_ONE : 0;
        dealt->force[i] =
            fibers[i] >= 0 ? (double)step_times(t->pressed, t->sum) / FORCE_ONE : 0;
    }
    for (int i = 0; i < count; i++)
        number[found[i].fiber] = 0;
}
