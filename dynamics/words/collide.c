/* collide.c - see collide.h. */
#include "collide.h"
#include "word_internal.h"

#include <math.h>
#include <quad.h>
#include <stdlib.h>
#include <string.h>

#define PUSH 0.5        /* the part of the depth that is undone each time */
enum { ROUNDS = 4 };    /* a letter between others is pushed by all of them */
#define SLOW_SPEED 0.25 /* approaching speeds below this do not bounce, units/s */

struct body {
    const struct dyn_word *word;
    int letter;
    double x0, x1, y0, y1, sense; /* bounds; 1 counterclockwise, -1 clockwise */
    double corner[4][2];
};

/* How far the deepest corner of another box is in front of a side of this one; negative: behind
 * the side. */
struct touch {
    double apart, nx, ny; /* the normal points out of the side's own box */
    int side, corner;
};

static bool body_make(const struct dyn_word *word, const struct dyn_network *n, int letter,
                      struct body *b)
{
    *b = (struct body){.word = word, .letter = letter};
    dyn_word_quad(word, n, letter, b->corner);
    b->x0 = b->y0 = INFINITY;
    b->x1 = b->y1 = -INFINITY;
    double area = 0;
    for (int i = 0; i < 4; i++) {
        const double *p = b->corner[i], *q = b->corner[(i + 1) % 4];
        area += p[0] * q[1] - p[1] * q[0];
        b->x0 = fmin(b->x0, p[0]);
        b->x1 = fmax(b->x1, p[0]);
        b->y0 = fmin(b->y0, p[1]);
        b->y1 = fmax(b->y1, p[1]);
    }
    b->sense = area < 0 ? -1 : 1;
    return dyn_quad_condition(b->corner) > 0;
}

static int by_x(const void *a, const void *b)
{
    const struct body *p = a, *q = b;
    if (p->x0 != q->x0)
        return p->x0 < q->x0 ? -1 : 1;
    return p->letter - q->letter;
}

/* Whether the letters are linked, and so do not collide. */
static bool are_linked(const struct dyn_network *n, const struct body *a, const struct body *b)
{
    int first = a->letter < b->letter ? a->letter : b->letter;
    if (a->word != b->word || abs(a->letter - b->letter) != 1 ||
        (int)a->word->style.box != DYN_BOX_INK)
        return false;
    const int *link = a->word->letters[first].link;
    return link[0] >= 0 && (!n->broken[link[0]] || !n->broken[link[1]]);
}

/* Finds the side of a behind which b lies least deep. */
static struct touch sides_look(const struct body *a, const struct body *b)
{
    struct touch best = {.apart = -INFINITY};
    for (int i = 0; i < 4; i++) {
        const double *p = a->corner[i], *q = a->corner[(i + 1) % 4];
        double dx = q[0] - p[0], dy = q[1] - p[1], length = sqrt(dx * dx + dy * dy);
        struct touch here = {INFINITY, a->sense * dy / length, -a->sense * dx / length, i, 0};
        for (int k = 0; k < 4; k++) {
            double d = (b->corner[k][0] - p[0]) * here.nx + (b->corner[k][1] - p[1]) * here.ny;
            if (d < here.apart) {
                here.apart = d;
                here.corner = k;
            }
        }
        if (here.apart > best.apart)
            best = here;
    }
    return best;
}

/* A corner and the side that it is behind: three masses, and the weights by which they move. */
struct contact {
    struct dyn_state *state[3];
    double part[3], inverse[3];
};

static struct contact contact_make(struct dyn_network *n, const struct body *a,
                                   const struct body *b, const struct touch *touch)
{
    const int *of_a = a->word->letters[a->letter].mass,
              *of_b = b->word->letters[b->letter].mass;
    const int masses[3] = {of_b[touch->corner], of_a[touch->side], of_a[(touch->side + 1) % 4]};
    struct contact c;
    for (int i = 0; i < 3; i++) {
        double mass = dyn_mass_row(n, MASS_MASS)[masses[i]] * n->world.mass;
        c.state[i] = &n->state[masses[i]];
        c.inverse[i] = n->hold[masses[i]] == DYN_FREE ? 1 / mass : 0;
    }
    double dx = c.state[2]->x - c.state[1]->x, dy = c.state[2]->y - c.state[1]->y;
    double t = ((c.state[0]->x - c.state[1]->x) * dx + (c.state[0]->y - c.state[1]->y) * dy) /
               (dx * dx + dy * dy);
    t = fmin(fmax(t, 0), 1);
    c.part[0] = 1;
    c.part[1] = t - 1;
    c.part[2] = -t;
    return c;
}

/* The velocity of the corner relative to the side, along (x, y). */
static double speed_along(const struct contact *c, double x, double y)
{
    double speed = 0;
    for (int i = 0; i < 3; i++)
        speed += c->part[i] * (c->state[i]->vx * x + c->state[i]->vy * y);
    return speed;
}

static void speeds_change(const struct contact *c, double x, double y, double impulse)
{
    for (int i = 0; i < 3; i++) {
        c->state[i]->vx += c->part[i] * c->inverse[i] * impulse * x;
        c->state[i]->vy += c->part[i] * c->inverse[i] * impulse * y;
    }
}

static void push(struct dyn_network *n, const struct body *a, const struct body *b,
                 const struct touch *touch)
{
    struct contact c = contact_make(n, a, b, touch);
    double x = touch->nx, y = touch->ny, give = 0;
    for (int i = 0; i < 3; i++)
        give += c.part[i] * c.part[i] * c.inverse[i];
    if (!(give > 0))
        return;
    for (int i = 0; i < 3; i++) {
        c.state[i]->x += c.part[i] * c.inverse[i] / give * PUSH * -touch->apart * x;
        c.state[i]->y += c.part[i] * c.inverse[i] / give * PUSH * -touch->apart * y;
    }
    double approach = -speed_along(&c, x, y);
    if (!(approach > 0))
        return;
    double e = approach > SLOW_SPEED ? n->world.restitution : 0;
    double impulse = (1 + e) * approach / give;
    speeds_change(&c, x, y, impulse);
    double along = speed_along(&c, -y, x), most = n->world.friction * impulse;
    speeds_change(&c, -y, x, -fmax(fmin(along / give, most), -most));
}

/* Separates a pair. False: they do not touch. */
static bool pair_meet(struct dyn_network *n, const struct body *a, const struct body *b)
{
    if (a->y1 <= b->y0 || b->y1 <= a->y0 || are_linked(n, a, b))
        return false;
    struct touch of_a = sides_look(a, b), of_b = sides_look(b, a);
    if (!(of_a.apart < 0 && of_b.apart < 0))
        return false;
    if (of_a.apart >= of_b.apart)
        push(n, a, b, &of_a);
    else
        push(n, b, a, &of_b);
    return true;
}

/* Collects all letters as they are now, from left to right. Returns how many can collide. */
static int bodies_make(const struct dyn_network *n, const struct dyn_word *const *words,
                       int words_count, struct body *bodies)
{
    int count = 0;
    for (int i = 0; i < words_count; i++)
        for (int k = 0; k < words[i]->letters_count; k++)
            count += body_make(words[i], n, k, &bodies[count]);
    qsort(bodies, (size_t)count, sizeof *bodies, by_x);
    return count;
}

enum dyn_status dyn_words_collide(struct dyn_network *n, const struct dyn_word *const *words,
                                  int words_count, int *contacts)
{
    size_t letters = 0;
    int first = 0;
    for (int i = 0; i < words_count; i++)
        letters += (size_t)words[i]->letters_count;
    struct body *bodies = malloc((letters + 1) * sizeof *bodies);
    if (!bodies)
        return dyn_fail(DYN_NO_MEMORY, "no memory for %zu letters", letters);
    for (int round = 0, found = 1; round < ROUNDS && found; round++) {
        int count = bodies_make(n, words, words_count, bodies);
        found = 0;
        for (int i = 0; i < count; i++)
            for (int k = i + 1; k < count && bodies[k].x0 < bodies[i].x1; k++)
                found += pair_meet(n, &bodies[i], &bodies[k]);
        first = round ? first : found;
    }
    free(bodies);
    if (contacts)
        *contacts = first;
    return DYN_OK;
}
