/* tiles.c - how large tiles are, where in local memory each array is, and how many turns of a
 * loop pay. See tiles.h.
 *
 * The time of a kernel of tiles is estimated as that of any other (choose.c),
 *
 *     N * fill * (max(c, b) + min(c, b)/4) + launch
 *
 *     c    = of each stage, ns * (rounds * group) / (width * height)
 *            rounds = (width + left + right) * (height + above + below) / group, rounded up
 *     b    = of each stage, far_ns * (width + left + right) * (height + above + below) /
 *          (width * height); and stored_ns
 *     fill = what a device of so many units does in the time that the tiles take, of which the sheet is a part: tiles that
 *            are partly beyond the sheet, and units that are idle while others make the last tiles
 *
 * and a quarter more where there is no room in local memory for a second group, which works
 * while the first waits at a barrier. */
#include "plan/tiles.h"

#include <math.h>
#include <stdlib.h>

#include "base/arrays.h"
#include "plan/plan.h"

/* Work-items that go in step load whole lines of a row: 32 elements of 4 bytes, at least. */
enum { ALIGNED = 8, WIDTH_LEAST = 32, WIDTH_MOST = 128, HEIGHT_MOST = 64 };

void tiling_finish(struct tiling *t)
{
    free(t->stages);
    free(t->arrays);
    free(t->looks);
    *t = (struct tiling){0};
}

/* ---- what is known ---- */

void tiling_begin(struct tiling *t, int stages)
{
    while (t->stages_capacity < stages)
        t->stages = array_grown(t->stages, &t->stages_capacity, sizeof *t->stages);
    for (int k = 0; k < stages; k++)
        t->stages[k] = (struct tile_stage){0};
    t->stages_count = stages;
    t->arrays_count = t->looks_count = 0;
    t->stored_ns = 0;
    t->reach = (struct tile_stage){0};
}

int tiling_array(struct tiling *t, struct tile_array array)
{
    if (t->arrays_count == t->arrays_capacity)
        t->arrays = array_grown(t->arrays, &t->arrays_capacity, sizeof *t->arrays);
    t->arrays[t->arrays_count] = array;
    return t->arrays_count++;
}

void tiling_look(struct tiling *t, struct tile_look look)
{
    int i = 0;
    while (i < t->looks_count && (t->looks[i].to != look.to || t->looks[i].from != look.from))
        i++;
    if (i == t->looks_count) {
        if (t->looks_count == t->looks_capacity)
            t->looks = array_grown(t->looks, &t->looks_capacity, sizeof *t->looks);
        t->looks[t->looks_count++] = look;
        return;
    }
    struct tile_look *l = &t->looks[i];
    widen(&l->left, look.left);
    widen(&l->right, look.right);
    widen(&l->above, look.above);
    widen(&l->below, look.below);
}

void tiling_extents(struct tiling *t)
{
    for (int k = t->stages_count - 1; k >= 0; k--)
        for (int i = 0; i < t->looks_count; i++) {
            const struct tile_look *l = &t->looks[i];
            if (l->to != k)
                continue;
            struct tile_stage *from = l->from < 0 ? &t->reach : &t->stages[l->from];
            widen(&from->left, t->stages[k].left + l->left);
            widen(&from->right, t->stages[k].right + l->right);
            widen(&from->above, t->stages[k].above + l->above);
            widen(&from->below, t->stages[k].below + l->below);
        }
}

static const double ALONE = 1.25;

/* ---- local memory ---- */

/* 0: no stage looks at it, and it is in no local memory. What is looked at far away makes it
 * large. */
static int64_t array_bytes(const struct tiling *t, const struct tile_array *a, int width,
                           int height)
{
    if (a->last == a->stage)
        return 0;
    const struct tile_stage *s = &t->stages[a->stage];
    int64_t elements =
        (int64_t)(width + s->left + s->right) * (int64_t)(height + s->above + s->below);
    return (elements * a->bytes + ALIGNED - 1) / ALIGNED * ALIGNED;
}

/* The most that is wanted at the same time. */
static int64_t bytes_alive(const struct tiling *t, int width, int height)
{
    int64_t most = 0;
    for (int k = 0; k < t->stages_count; k++) {
        int64_t alive = 0;
        for (int i = 0; i < t->arrays_count; i++)
            if (t->arrays[i].stage <= k && t->arrays[i].last >= k)
                alive += array_bytes(t, &t->arrays[i], width, height);
        most = alive > most ? alive : most;
    }
    return most;
}

static bool live_together(const struct tile_array *a, const struct tile_array *b)
{
    return a->stage <= b->last && b->stage <= a->last;
}

/* Each where first there is room, in the order of stages. Returns how many bytes that takes,
 * not much more than are alive at the same time. */
static int64_t place(struct tiling *t, int width, int height)
{
    int64_t most = 0;
    for (int i = 0; i < t->arrays_count; i++) {
        struct tile_array *a = &t->arrays[i];
        int64_t bytes = array_bytes(t, a, width, height), at = 0;
        for (int k = 0; k < i; k++) {
            const struct tile_array *b = &t->arrays[k];
            int64_t end = b->at + array_bytes(t, b, width, height);
            if (live_together(a, b) && at < end && b->at < at + bytes) { /* begin again */
                at = end;
                k = -1;
            }
        }
        a->at = (int)at;
        most = at + bytes > most ? at + bytes : most;
    }
    return most;
}

/* ---- time ---- */

static double up(double all, double parts)
{
    return ceil(all / parts);
}

static double time_of(const struct tiling *t, const struct vpset *set,
                      const struct device_shape *shape, int width, int height)
{
    double own = (double)width * height, c = 0, b = t->stored_ns, units = shape->units,
           tiles = up(set->width, width) * up((double)set->rows, height),
           fill = up(tiles, units) * units * own / (double)set->count;
    for (int k = 0; k < t->stages_count; k++) {
        const struct tile_stage *s = &t->stages[k];
        double all = (double)(width + s->left + s->right) * (height + s->above + s->below);
        c += s->ns * up(all, shape->group) * shape->group / own;
        b += s->far_ns * all / own;
    }
    return (double)set->count * fill * (fmax(c, b) + fmin(c, b) / 4) + shape->launch_ns;
}

/* ---- which ---- */

struct choice {
    int width, height;
    double ns;
};

static void try_tile(struct tiling *t, const struct vpset *set,
                     const struct device_shape *shape, bool placed, int width, int height,
                     struct choice *best)
{
    double ns = time_of(t, set, shape, width, height);
    if (ns >= best->ns)
        return;
    int64_t bytes = bytes_alive(t, width, height);
    if (bytes <= shape->local_bytes && placed)
        bytes = place(t, width, height);
    if (bytes > shape->local_bytes)
        return;
    if (2 * bytes > shape->local_bytes)
        ns *= ALONE;
    if (ns < best->ns)
        *best = (struct choice){width, height, ns};
}

bool tiles_choose(struct tiling *t, const struct vpset *set, const struct device_shape *shape,
                  bool placed)
{
    struct choice best = {.ns = HUGE_VAL};
    if (shape->tile_width)
        try_tile(t, set, shape, placed, shape->tile_width, shape->tile_height, &best);
    for (int width = WIDTH_LEAST; !shape->tile_width && width <= WIDTH_MOST; width *= 2)
        for (int height = 2; height <= HEIGHT_MOST; height += height < 4 ? 2 : 4)
            if (width * height >= shape->group)
                try_tile(t, set, shape, placed, width, height, &best);
    if (!best.width)
        return false;
    t->width = best.width;
    t->height = best.height;
    t->ns = best.ns;
    t->bytes = (int)(placed ? place(t, best.width, best.height)
                            : bytes_alive(t, best.width, best.height));
    return true;
}

/* ---- turns of a loop ---- */

/* So many turns, one after the other: later ones find in local memory what earlier ones leave
 * in arrays, and that much more is looked at around the tile. */
static void turns_of(const struct tiling *one, const struct device_shape *shape, int turns,
                     struct tiling *all)
{
    int stages = one->stages_count;
    tiling_begin(all, turns * stages);
    all->stored_ns = one->stored_ns;
    for (int i = 0; i < turns * stages; i++) {
        struct tile_stage *s = &all->stages[i];
        int after = turns - 1 - i / stages;
        *s = one->stages[i % stages];
        s->left += after * one->reach.left;
        s->right += after * one->reach.right;
        s->above += after * one->reach.above;
        s->below += after * one->reach.below;
        if (i >= stages) { /* near now */
            s->ns += s->far_ns * shape->near_byte_ns / shape->byte_ns;
            s->far_ns = 0;
        }
    }
    for (int i = 0; i < turns * one->arrays_count; i++) {
        struct tile_array a = one->arrays[i % one->arrays_count];
        int turn = i / one->arrays_count;
        if (a.stays && turn < turns - 1) {
            a.last = 2 * stages - 1;
            all->stages[turn * stages + a.stage].ns += (double)a.bytes * shape->near_byte_ns;
        }
        a.stage += turn * stages;
        a.last += turn * stages;
        tiling_array(all, a);
    }
}

int tiles_turns(const struct tiling *one, const struct vpset *set,
                const struct device_shape *shape, double other_ns)
{
    int best = 1;
    double least = fmin(one->ns, other_ns);
    struct tiling all = {0};
    for (int turns = 2; turns <= 2 * shape->turns; turns++) {
        turns_of(one, shape, turns, &all);
        if (!tiles_choose(&all, set, shape, false))
            break;
        if (shape->always_strips || all.ns / turns < least) {
            best = turns;
            least = all.ns / turns;
        }
    }
    tiling_finish(&all);
    return best;
}
