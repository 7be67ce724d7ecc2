/* springs_openmp.c - large networks in C with OpenMP: see springs_scene.h.
 *
 * Two threads must not add to the same mass. So each spring stores its force, and each mass
 * sums the forces of its springs, with opposite signs for their first and second ends. Each
 * mass has a list of its springs.
 */
#include <math.h>
#include <stdlib.h>

#include "harness.h"
#include "springs_scene.h"

struct state {
    double x, y, vx, vy;
};

struct springs_openmp {
    struct state *state;
    double (*force)[2];
    double *inverse; /* 1/m; 0 of those that are fixed */
    struct springs_spring *springs;
    int *first,
        /* springs of mass i: of[first[i]] .. of[first[i + 1] - 1]; ~spring where it is the
         * second end */
        *of;
    int masses_count, springs_count;
    double gravity;
};

static void rows_make(struct springs_openmp *p)
{
    for (int i = 0; i < p->springs_count; i++) {
        p->first[p->springs[i].a + 1]++;
        p->first[p->springs[i].b + 1]++;
    }
    for (int i = 0; i < p->masses_count; i++)
        p->first[i + 1] += p->first[i];
    for (int i = 0; i < p->springs_count; i++) {
        p->of[p->first[p->springs[i].a]++] = i;
        p->of[p->first[p->springs[i].b]++] = ~i;
    }
    for (int i = p->masses_count; i > 0; i--)
        p->first[i] = p->first[i - 1];
    p->first[0] = 0;
}

struct springs_openmp *springs_openmp_create(const struct springs_scene *s)
{
    struct springs_openmp *p = calloc(1, sizeof *p);
    size_t masses = (size_t)s->masses_count, springs = (size_t)s->springs_count;
    if (p) {
        p->state = malloc(masses * sizeof *p->state);
        p->force = malloc(springs * sizeof *p->force);
        p->inverse = malloc(masses * sizeof *p->inverse);
        p->springs = malloc(springs * sizeof *p->springs);
        p->first = calloc(masses + 2, sizeof *p->first);
        p->of = malloc(2 * springs * sizeof *p->of);
    }
    if (!p || !p->state || !p->force || !p->inverse || !p->springs || !p->first || !p->of) {
        springs_openmp_destroy(p);
        bench_fail("no memory for %zu springs in OpenMP", springs);
        return NULL;
    }
    p->masses_count = s->masses_count;
    p->springs_count = s->springs_count;
    p->gravity = s->gravity;
    for (size_t i = 0; i < masses; i++) {
        const struct springs_mass *m = &s->masses[i];
        p->state[i] = (struct state){m->x, m->y, m->vx, m->vy};
        p->inverse[i] = m->fixed ? 0 : 1 / m->mass;
    }
    for (size_t i = 0; i < springs; i++)
        p->springs[i] = s->springs[i];
    rows_make(p);
    return p;
}

void springs_openmp_destroy(struct springs_openmp *p)
{
    if (p) {
        free(p->state);
        free(p->force);
        free(p->inverse);
        free(p->springs);
        free(p->first);
        free(p->of);
    }
    free(p);
}

static void force_find(struct springs_openmp *p, int i)
{
    const struct springs_spring *spring = &p->springs[i];
    const struct state *a = &p->state[spring->a], *b = &p->state[spring->b];
    double dx = b->x - a->x, dy = b->y - a->y, length = sqrt(dx * dx + dy * dy);
    double along = (b->vx - a->vx) * dx + (b->vy - a->vy) * dy;
    double pull =
        (spring->constant * (length - spring->rest_length) + spring->damping * along / length) /
        length;
    p->force[i][0] = pull * dx;
    p->force[i][1] = pull * dy;
}

static void mass_move(struct springs_openmp *p, int i, double dt_s)
{
    double fx = 0, fy = 0;
    struct state *m = &p->state[i];
    for (int k = p->first[i]; k < p->first[i + 1]; k++) {
        int of = p->of[k];
        const double *f = p->force[of < 0 ? ~of : of];
        fx += of < 0 ? -f[0] : f[0];
        fy += of < 0 ? -f[1] : f[1];
    }
    bool moves = p->inverse[i] > 0;
    m->vx = moves ? m->vx + dt_s * (fx * p->inverse[i]) : 0;
    m->vy = moves ? m->vy + dt_s * (fy * p->inverse[i] - p->gravity) : 0;
    m->x += dt_s * m->vx;
    m->y += dt_s * m->vy;
}

void springs_openmp_step(struct springs_openmp *p, double dt_s, int count)
{
    for (; count > 0; count--) {
#pragma omp parallel
        {
#pragma omp for
            for (int i = 0; i < p->springs_count; i++)
                force_find(p, i);
#pragma omp for
            for (int i = 0; i < p->masses_count; i++)
                mass_move(p, i, dt_s);
        }
    }
}

void springs_openmp_state(const struct springs_openmp *p, int mass, double state[4])
{
    const struct state *m = &p->state[mass];
    state[0] = m->x;
    state[1] = m->y;
    state[2] = m->vx;
    state[3] = m->vy;
}
