/* springs_plain.c - masses and springs in plain loops: see springs_scene.h. */
#include <math.h>
#include <stdlib.h>

#include "harness.h"
#include "springs_scene.h"

struct mass {
    double x, y, vx, vy, fx, fy, mass;
    bool fixed;
};

struct springs_plain {
    struct mass *masses;
    struct springs_spring *springs;
    struct springs_scene scene; /* its numbers; the arrays are the maker's */
};

struct springs_plain *springs_plain_create(const struct springs_scene *s)
{
    struct springs_plain *p = calloc(1, sizeof *p);
    size_t masses = (size_t)s->masses_count, springs = (size_t)s->springs_count;
    if (p) {
        p->scene = *s;
        p->masses = calloc(masses, sizeof *p->masses);
        p->springs = malloc(springs * sizeof *p->springs);
    }
    if (!p || !p->masses || !p->springs) {
        springs_plain_destroy(p);
        bench_fail("no memory for %zu masses in plain C", masses);
        return NULL;
    }
    for (size_t i = 0; i < masses; i++) {
        const struct springs_mass *m = &s->masses[i];
        p->masses[i] = (struct mass){m->x, m->y, m->vx, m->vy, 0, 0, m->mass, m->fixed};
    }
    for (size_t i = 0; i < springs; i++)
        p->springs[i] = s->springs[i];
    return p;
}

void springs_plain_destroy(struct springs_plain *p)
{
    if (p) {
        free(p->masses);
        free(p->springs);
    }
    free(p);
}

static void floor_meet(const struct springs_scene *s, struct mass *m, double dt_s)
{
    double speed = -m->vy;
    if (!(m->y < 0 && speed > 0))
        return;
    double e = speed > 2 * dt_s * s->gravity ? s->restitution : 0;
    m->y = e * fmin(-m->y, dt_s * speed);
    m->vy = e * speed;
    double grip = s->friction * (speed + m->vy);
    m->vx -= fmax(fmin(m->vx, grip), -grip);
}

static void one_step(struct springs_plain *p, double dt_s)
{
    const struct springs_scene *s = &p->scene;
    for (int i = 0; i < s->springs_count; i++) {
        const struct springs_spring *spring = &p->springs[i];
        struct mass *a = &p->masses[spring->a], *b = &p->masses[spring->b];
        double dx = b->x - a->x, dy = b->y - a->y, length = sqrt(dx * dx + dy * dy);
        double along = (b->vx - a->vx) * dx + (b->vy - a->vy) * dy;
        double pull = (spring->constant * (length - spring->rest_length) +
                       spring->damping * along / length) /
                      length;
        a->fx += pull * dx;
        a->fy += pull * dy;
        b->fx -= pull * dx;
        b->fy -= pull * dy;
    }
    for (int i = 0; i < s->masses_count; i++) {
        struct mass *m = &p->masses[i];
        if (m->fixed) {
            m->fx = m->fy = m->vx = m->vy = 0;
            continue;
        }
        m->vx += dt_s * (m->fx / m->mass);
        m->vy += dt_s * (m->fy / m->mass - s->gravity);
        m->x += dt_s * m->vx;
        m->y += dt_s * m->vy;
        m->fx = m->fy = 0;
        if (s->has_floor)
            floor_meet(s, m, dt_s);
    }
}

void springs_plain_step(struct springs_plain *p, double dt_s, int count)
{
    for (; count > 0; count--)
        one_step(p, dt_s);
}

void springs_plain_state(const struct springs_plain *p, int mass, double state[4])
{
    const struct mass *m = &p->masses[mass];
    state[0] = m->x;
    state[1] = m->y;
    state[2] = m->vx;
    state[3] = m->vy;
}
