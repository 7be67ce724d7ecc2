/* splatter.c - drops from a shaken brush.
 *
 * A drop that strikes paper spreads to a puddle. Its rim breaks up into fingers, which are
 * longer the harder it strikes; the longest throws a satellite off. A drop that comes aslant is
 * long, blunt behind, and pointed where it flies to; a satellite lies before its point:
 *
 *          _,              .
 *       .-' '-._       __,--.
 *      (        )     (      '-._    .
 *       '-. .--'       '--__.--'
 *          V
 *
 * The rim's distance from the middle, for each direction, is that of a disc times 1 + wobble +
 * fingers + point, and the puddle's area is the disc's. */
#include "arguments/rows.h"
#include "model/brush_internal.h"
#include "techniques.h"

#include <math.h>
#include <stdlib.h>

#define PI 3.14159265358979323846

enum { DIRECTIONS = 96, FINGERS_LEAST = 5, FINGERS_MORE = 5, WOBBLES = 3, SATELLITES = 3 };

/* Of the largest drops; small ones strike more softly, and are rounder. */
#define WOBBLE 0.1
#define FINGER 0.24      /* in the mean */
#define FINGER_MOST 0.55 /* a longer one has come off: a satellite */
#define FINGER_FIRST 0.4 /* one goes that far at least */
#define FINGER_WIDE 0.3  /* radians */
#define POINT 0.9        /* for each unit of length above 1 */
#define POINT_MOST 0.9
#define POINT_WIDE 0.3  /* radians */
#define SOFTEST 0.45    /* the smallest drop's part of all that */
#define SATELLITE 0.14  /* its radius, of the drop's */
#define ROUND_BELOW 1.0 /* fibers: of a smaller radius no rim is seen */

struct drop {
    double x, y, radius, length; /* radius: across; length: ratio of length to width */
    double c, s;                 /* the direction along */
    double strength;             /* 0..1 */
    double rim[DIRECTIONS];      /* from the direction along, of the radius */
    double largest;              /* of rim[] */
};

/* Most drops fall near, within the radius, and few far. Large drops are rare, and drops that
 * fly far are small. */
static struct drop drop_make(const struct paper_splatter *s, int i)
{
    uint64_t n = (uint64_t)i;
    double away = sqrt(-2 * log(1 - 0.99 * sheet_chance(s->seed, n, 1))) * s->radius / 2;
    double angle = 2 * PI * sheet_chance(s->seed, n, 2);
    double large = pow(sheet_chance(s->seed, n, 3), 4);
    double c = cos(s->toward), sn = sin(s->toward);
    double along = away * cos(angle), across = away * sin(angle);
    if (s->thrown > 0) /* drops that are thrown harder fly further */
        along = fabs(along) * (1 + s->thrown);
    struct drop d = {.x = s->x + c * along - sn * across,
                     .y = s->y + sn * along + c * across,
                     .radius = s->size[0] + (s->size[1] - s->size[0]) * large,
                     .length = 1 + s->thrown * (0.3 + 0.7 * sheet_chance(s->seed, n, 4)),
                     .c = c,
                     .s = sn,
                     .strength = 0.55 + 0.45 * sheet_chance(s->seed, n, 5)};
    if (s->thrown > 0) { /* a drop's long axis points away from its origin */
        double fx = d.x - s->x + c * s->radius, fy = d.y - s->y + sn * s->radius;
        double far = hypot(fx, fy);
        d.c = far > 0 ? fx / far : c;
        d.s = far > 0 ? fy / far : sn;
    }
    return d;
}

/* ---- the rim ---- */

/* The angle from a to b, -PI..PI. */
static double turn(double a, double b)
{
    return remainder(b - a, 2 * PI);
}

static double bump(double away, double wide)
{
    return exp(-away * away / (wide * wide));
}

/* Chance number k of the drop's shape, 0..1; those before it are its place's. */
static double shape_chance(const struct paper_splatter *s, int drop, int k)
{
    return sheet_chance(s->seed, (uint64_t)drop, (uint64_t)(8 + k));
}

/* How hard a drop strikes, 0..1. */
static double hardness(const struct paper_splatter *s, const struct drop *d)
{
    return fmin(1, d->radius / s->size[1]);
}

/* Adds waves of two, three and four around. */
static void rim_wobble(const struct paper_splatter *s, int number, double high, double *rim)
{
    for (int k = 0; k < WOBBLES; k++) {
        const double most = high * sqrt(2.0 / (k + 1)) *
                            (2 * shape_chance(s, number, 2 + 2 * k) - 1),
                     first = 2 * PI * shape_chance(s, number, 3 + 2 * k);
        for (int i = 0; i < DIRECTIONS; i++)
            rim[i] += most * cos((k + 2) * 2 * PI * i / DIRECTIONS + first);
    }
}

/* Adds fingers, which stand at uneven distances, and of which most are short, and the first is
 * not. */
static void rim_finger(const struct paper_splatter *s, int number, double hard, double *rim)
{
    const int fingers =
        FINGERS_LEAST + (int)(FINGERS_MORE * hard * shape_chance(s, number, 0) + 0.5);
    const double first = 2 * PI * shape_chance(s, number, 1), apart = 2 * PI / fingers;
    for (int k = 0; k < fingers; k++) {
        const double where = first + apart * (k + 0.8 * shape_chance(s, number, 10 + k)),
                     chance = shape_chance(s, number, 30 + k),
                     most = fmin(FINGER_MOST, -FINGER * log(1 - 0.999 * chance)),
                     high = hard * fmax(most, k == 0 ? FINGER_FIRST : 0);
        for (int i = 0; i < DIRECTIONS; i++)
            rim[i] += high * bump(turn(where, 2 * PI * i / DIRECTIONS), FINGER_WIDE);
    }
}

static void rim_make(const struct paper_splatter *s, int number, struct drop *d)
{
    const double hard = SOFTEST + (1 - SOFTEST) * hardness(s, d),
                 point = hard * fmin(POINT_MOST, POINT * (d->length - 1));
    for (int i = 0; i < DIRECTIONS; i++)
        d->rim[i] = 1;
    if (d->radius >= ROUND_BELOW) {
        rim_wobble(s, number, hard * WOBBLE, d->rim);
        rim_finger(s, number, hard, d->rim);
        for (int i = 0; i < DIRECTIONS; i++)
            d->rim[i] += point * bump(turn(0, 2 * PI * i / DIRECTIONS), POINT_WIDE);
    }
    double square = 0;
    for (int i = 0; i < DIRECTIONS; i++)
        square += d->rim[i] * d->rim[i] / DIRECTIONS;
    for (int i = 0; i < DIRECTIONS; i++) {
        d->rim[i] /= sqrt(square);
        d->largest = fmax(d->largest, d->rim[i]);
    }
}

static double rim_at(const struct drop *d, double u, double v)
{
    double at = atan2(v, u) * DIRECTIONS / (2 * PI);
    at = at < 0 ? at + DIRECTIONS : at;
    const int i = (int)at % DIRECTIONS;
    const double part = at - floor(at);
    return (1 - part) * d->rim[i] + part * d->rim[(i + 1) % DIRECTIONS];
}

/* ---- drawing ---- */

static void drop_draw(const struct drop *d, struct paper_screen *screen)
{
    double reach = d->radius * d->length * d->largest + 1;
    int x1 = (int)fmax(0, floor(d->x - reach)), y1 = (int)fmax(0, floor(d->y - reach));
    int x2 = (int)fmin(screen->width_px, ceil(d->x + reach));
    int y2 = (int)fmin(screen->height_px, ceil(d->y + reach));
    for (int row = y1; row < y2; row++)
        for (int column = x1; column < x2; column++) {
            double x = column + 0.5 - d->x, y = row + 0.5 - d->y;
            double u = (d->c * x + d->s * y) / d->length, v = d->c * y - d->s * x;
            const double away = hypot(u, v);
            if (away > d->radius * d->largest + 0.5)
                continue;
            double inside = fmin(1, d->radius * rim_at(d, u, v) + 0.5 - away);
            uint8_t *at =
                &screen->gray[(size_t)row * (size_t)screen->width_px + (size_t)column];
            uint8_t gray = (uint8_t)lround(255 * d->strength * fmax(0, inside));
            if (gray > *at)
                *at = gray;
        }
}

/* Before the rim's outermost place, and before fingers by chance: small round drops. */
static void satellites_draw(const struct paper_splatter *s, int number, const struct drop *d,
                            struct paper_screen *screen)
{
    const double hard = hardness(s, d);
    int farthest = 0;
    for (int i = 1; i < DIRECTIONS; i++)
        farthest = d->rim[i] > d->rim[farthest] ? i : farthest;
    for (int k = 0; k < SATELLITES; k++) {
        if (shape_chance(s, number, 50 + k) > hard * (k == 0 ? 1.2 : 0.7))
            continue;
        const int any = (int)(shape_chance(s, number, 53 + k) * DIRECTIONS) % DIRECTIONS,
                  i = k == 0 ? farthest : any;
        const double gap = 0.25 + 0.5 * shape_chance(s, number, 56 + k),
                     at = 2 * PI * i / DIRECTIONS, far = d->radius * (d->rim[i] + gap),
                     u = far * d->length * cos(at), v = far * sin(at);
        struct drop small = {.x = d->x + d->c * u - d->s * v,
                             .y = d->y + d->s * u + d->c * v,
                             .radius = d->radius * SATELLITE *
                                       (0.5 + shape_chance(s, number, 59 + k)),
                             .length = 1 + (d->length - 1) / 2,
                             .c = d->c,
                             .s = d->s,
                             .strength = d->strength,
                             .largest = 1};
        for (int j = 0; j < DIRECTIONS; j++)
            small.rim[j] = 1;
        drop_draw(&small, screen);
    }
}

enum paper_status paper_sheet_splatter(struct paper_sheet *p, const struct paper_splatter *s)
{
    enum paper_status status =
        paper_members_check(&paper_splatter_members, s, "splatter's ", "");
    if (status == PAPER_OK && !(s->size[1] >= s->size[0]))
        status = paper_fail(PAPER_BAD_ARGUMENT,
                            "splatter's most size must be %g or more, its least (got %g)",
                            s->size[0], s->size[1]);
    if (status != PAPER_OK)
        return status;
    struct paper_screen screen = {.width_px = p->page.grid.width,
                                  .height_px = p->page.grid.height};
    screen.gray = calloc((size_t)screen.width_px, (size_t)screen.height_px);
    if (!screen.gray)
        return paper_fail(PAPER_NO_MEMORY, "no memory for splatter");
    for (int i = 0; i < s->drops; i++) {
        struct drop d = drop_make(s, i);
        if (!paper_within(d.x, -1e7, 1e7) || !paper_within(d.y, -1e7, 1e7))
            continue;
        rim_make(s, i, &d);
        drop_draw(&d, &screen);
        satellites_draw(s, i, &d, &screen);
    }
    status = paper_sheet_put(p, &screen, 0, 0, s->amount);
    free(screen.gray);
    return status;
}
