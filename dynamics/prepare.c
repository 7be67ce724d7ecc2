/* prepare.c - computes the parameters that a step reads from those that were set: see
 * internal.h and step.h. */
#include "bounce.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The part of a stable step that is taken where masses bounce and lose nothing. */
#define ELASTIC_PART (1.0 / 32)

enum { MASS_ROWS = 10, SPRING_ROWS = 4, SPRING_NUMBERS = 3 };

/* For each mass, values that the kernels do not read. */
struct sums {
    double *inverse;             /* that of dyn_prepared */
    double *stiffness, *damping; /* K and C of step.h */
    double *soft;                /* the factor by which its springs must be softened */
};

void dyn_prepared_finish(struct dyn_prepared *p)
{
    dyn_bounces_finish(p);
    free(p->mass_block);
    free(p->spring_block);
    *p = (struct dyn_prepared){0};
}

static bool block_reserve(double **block, size_t *capacity, size_t doubles)
{
    if (doubles <= *capacity)
        return true;
    doubles += doubles / 2;
    double *grown = aligned_alloc(64, (doubles * sizeof(double) + 63) / 64 * 64);
    if (!grown)
        return false;
    free(*block);
    *block = grown;
    *capacity = doubles;
    return true;
}

static bool room_make(struct dyn_network *n, struct sums *sums)
{
    struct dyn_prepared *p = &n->prepared;
    size_t masses = dyn_masses_padded(n->masses_count);
    size_t springs = ((size_t)n->springs_count + 7) / 8 * 8;
    if (!block_reserve(&p->mass_block, &p->mass_capacity, masses * MASS_ROWS) ||
        !block_reserve(&p->spring_block, &p->spring_capacity,
                       springs * SPRING_ROWS + springs * SPRING_NUMBERS / 2 + 8))
        return false;
    double **rows[MASS_ROWS] = {&p->kick,         &p->keep,      &p->push_x,     &p->push_y,
                                &p->restitution,  &p->friction,  &sums->inverse, &sums->soft,
                                &sums->stiffness, &sums->damping};
    for (size_t i = 0; i < MASS_ROWS; i++)
        *rows[i] = p->mass_block + i * masses;
    memset(p->mass_block, 0, masses * MASS_ROWS * sizeof(double));
    p->inverse = sums->inverse;
    struct dyn_packed *s = &p->springs;
    double **spring_rows[SPRING_ROWS] = {&s->k, &s->k_rest, &s->c, &s->limit};
    for (size_t i = 0; i < SPRING_ROWS; i++)
        *spring_rows[i] = p->spring_block + i * springs;
    int32_t *numbers = (int32_t *)(void *)(p->spring_block + SPRING_ROWS * springs);
    s->at[0] = numbers;
    s->at[1] = numbers + springs;
    s->which = numbers + 2 * springs;
    return true;
}

static void masses_scale(struct dyn_network *n, const struct sums *sums)
{
    struct dyn_prepared *p = &n->prepared;
    for (int i = 0; i < n->masses_count; i++) {
        double mass = dyn_mass_row(n, MASS_MASS)[i] * n->world.mass;
        sums->inverse[i] = n->hold[i] == DYN_FREE ? 1 / mass : 0;
        p->restitution[i] =
            fmin(dyn_mass_row(n, MASS_RESTITUTION)[i] * n->world.restitution, 1);
        p->friction[i] = dyn_mass_row(n, MASS_FRICTION)[i] * n->world.friction;
    }
}

static void packed_look(struct dyn_packed *s, int count)
{
    int again = 0;
    s->breaks = false;
    for (int i = 0; i < count; i++) {
        s->breaks = s->breaks || isfinite(s->limit[i]);
        again += i > 0 && s->at[0][i] == s->at[0][i - 1];
    }
    s->carries = again >= count / 3;
}

static void springs_pack(struct dyn_network *n, const struct sums *sums)
{
    struct dyn_packed *s = &n->prepared.springs;
    const struct dyn_world *w = &n->world;
    int count = 0;
    for (int i = 0; i < n->springs_count; i++) {
        if (n->broken[i])
            continue;
        int a = n->end[i][0], b = n->end[i][1];
        double k = dyn_spring_row(n, SPRING_CONSTANT)[i] * w->stiffness;
        double c = dyn_spring_row(n, SPRING_DAMPING)[i] * w->damping;
        double rest = dyn_spring_row(n, SPRING_REST)[i] * w->rest;
        double strain = dyn_spring_row(n, SPRING_BREAKING)[i] * w->breaking;
        s->at[0][count] = a * DYN_FORCE_BYTES;
        s->at[1][count] = b * DYN_FORCE_BYTES;
        s->k[count] = k;
        s->k_rest[count] = k * rest;
        s->c[count] = c;
        s->limit[count] = rest > 0 && isfinite(strain) ? rest * (1 + strain) : INFINITY;
        s->which[count++] = i;
        double times_a = sums->inverse[b] > 0 ? 2 * sums->inverse[a] : sums->inverse[a];
        double times_b = sums->inverse[a] > 0 ? 2 * sums->inverse[b] : sums->inverse[b];
        sums->stiffness[a] += times_a * k;
        sums->stiffness[b] += times_b * k;
        sums->damping[a] += times_a * c;
        sums->damping[b] += times_b * c;
    }
    packed_look(s, count);
    for (; count % 8; count++) {
        s->at[0][count] = s->at[1][count] = n->masses_count * DYN_FORCE_BYTES;
        s->k[count] = s->k_rest[count] = s->c[count] = 0;
        s->limit[count] = INFINITY;
        s->which[count] = -1;
    }
    s->count = count;
    for (int i = 0; i < n->pulls_count; i++) {
        const struct dyn_pull *pull = &n->pulls[i];
        sums->stiffness[pull->mass] += sums->inverse[pull->mass] * pull->constant;
        sums->damping[pull->mass] += sums->inverse[pull->mass] * pull->damping;
    }
}

static double stable_part(const struct dyn_network *n, const struct sums *sums)
{
    double least = INFINITY;
    for (int i = 0; i < n->masses_count; i++) {
        double c = sums->damping[i], k = sums->stiffness[i];
        if (k > 0 || c > 0)
            least = fmin(least, 4 / (c + sqrt(c * c + 4 * k)));
    }
    return least;
}

/* Softens springs on masses that would need more parts than the maximum. */
static int soften(struct dyn_network *n, const struct sums *sums, double h)
{
    struct dyn_packed *s = &n->prepared.springs;
    double longest = h / n->world.safety;
    int softened = 0;
    for (int i = 0; i < n->masses_count; i++) {
        double asks =
            longest * sums->damping[i] / 2 + longest * longest * sums->stiffness[i] / 4;
        sums->soft[i] = asks > 1 ? 1 / asks : 1;
    }
    for (int i = 0; i < s->count; i++) {
        if (s->which[i] < 0)
            continue;
        double soft =
            fmin(sums->soft[dyn_packed_end(s, 0, i)], sums->soft[dyn_packed_end(s, 1, i)]);
        s->k[i] *= soft;
        s->k_rest[i] *= soft;
        s->c[i] *= soft;
        softened += soft < 1;
    }
    for (int i = 0; i < n->pulls_count; i++)
        n->prepared.pull_soft[i] = sums->soft[n->pulls[i].mass];
    return softened;
}

/* True if a mass that can bounce keeps nearly all of its speed: then nothing but the length of
 * a part says how well energy is kept. */
static bool elastic(const struct dyn_network *n)
{
    double most = 0;
    if (!dyn_bounces_possible(&n->world))
        return false;
    for (int i = 0; i < n->masses_count; i++)
        if (n->hold[i] == DYN_FREE)
            most = fmax(most, n->prepared.restitution[i]);
    return most > DYN_ELASTIC;
}

static void parts_find(struct dyn_network *n, const struct sums *sums, double dt_s)
{
    struct dyn_prepared *p = &n->prepared;
    double stable = stable_part(n, sums);
    double parts = ceil(dt_s / (n->world.safety * stable)); /* 0 where stable is infinite */
    p->plan = (struct dyn_plan){.stable_s = stable, .parts = 1};
    for (int i = 0; i < n->pulls_count; i++)
        p->pull_soft[i] = 1;
    if (parts > DYN_PARTS_MAX) {
        p->plan.parts = DYN_PARTS_MAX;
        p->plan.softened = soften(n, sums, dt_s / DYN_PARTS_MAX);
    } else {
        if (elastic(n))
            parts = fmax(parts, fmin(ceil(dt_s / (ELASTIC_PART * stable)), DYN_PARTS_MAX));
        p->plan.parts = (int)fmax(parts, 1);
    }
    p->dt_s = dt_s;
    p->h = dt_s / p->plan.parts;
}

static void kicks_make(struct dyn_network *n, const struct sums *sums)
{
    struct dyn_prepared *p = &n->prepared;
    const struct dyn_world *w = &n->world;
    double h = (int)w->integrator == DYN_VERLET ? p->h / 2 : p->h;
    for (int i = 0; i < n->masses_count; i++) {
        double inverse = sums->inverse[i];
        double slowing = h * inverse * (w->drag + dyn_mass_row(n, MASS_DRAG)[i]);
        if (!(inverse > 0))
            continue;
        double keep = 1 / (1 + slowing);
        p->keep[i] = keep;
        p->kick[i] = h * inverse * keep;
        p->push_x[i] = slowing * w->wind_x * keep;
        p->push_y[i] =
            (slowing * w->wind_y - h * w->gravity * dyn_mass_row(n, MASS_GRAVITY)[i]) * keep;
    }
}

enum dyn_status dyn_prepare(struct dyn_network *n, double dt_s)
{
    struct sums sums;
    if (!n->changed && n->prepared.dt_s == dt_s)
        return DYN_OK;
    if (!room_make(n, &sums)) {
        n->changed = true; /* half of it may be there */
        return dyn_fail(DYN_NO_MEMORY, "no memory for a step of %d masses and %d springs",
                        n->masses_count, n->springs_count);
    }
    masses_scale(n, &sums);
    springs_pack(n, &sums);
    if (!dyn_bounces_prepare(n)) {
        n->changed = true;
        return dyn_fail(DYN_NO_MEMORY, "no memory for the bounces of %d masses",
                        n->masses_count);
    }
    parts_find(n, &sums, dt_s);
    kicks_make(n, &sums);
    n->changed = false;
    return DYN_OK;
}
