/* step.c - steps as jobs for the kernels: see step.h. */
#include "step.h"
#include "bounce.h"

#ifdef DYN_X86
#include <cpuid.h>
#endif
#include <math.h>

/* ---- instruction sets ---- */

typedef void step_kernel(struct dyn_job *job);

static step_kernel *kernel;

enum dyn_simd dyn_simd_use(enum dyn_simd most)
{
    enum dyn_simd used = DYN_SIMD_PLAIN;
    kernel = dyn_kernel_plain;
#ifdef DYN_X86
    __builtin_cpu_init();
    if (most >= DYN_SIMD_AVX2 && __builtin_cpu_supports("avx2")) {
        used = DYN_SIMD_AVX2;
        kernel = dyn_kernel_avx2;
    }
    if (most >= DYN_SIMD_AVX512 && used == DYN_SIMD_AVX2 && __builtin_cpu_supports("avx512f") &&
        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq")) {
        used = DYN_SIMD_AVX512;
        kernel = dyn_kernel_avx512;
    }
#else
    (void)most;
#endif
    return used;
}

const char *dyn_simd_name(enum dyn_simd simd)
{
    static const char *const names[] = {"plain C", "AVX2", "AVX-512"};
    return names[simd];
}

/* True if the processor computes 512 bits in two halves, as AMD's family 19h (Zen 4) does: then
 * AVX2 is faster, for moving lanes about takes less. */
static bool vectors_halved(void)
{
#ifdef DYN_X86
    unsigned a, b, c, d, family;
    if (!__get_cpuid(0, &a, &b, &c, &d) || b != signature_AMD_ebx || d != signature_AMD_edx ||
        c != signature_AMD_ecx || !__get_cpuid(1, &a, &b, &c, &d))
        return false;
    family = (a >> 8 & 15) + (a >> 20 & 255);
    return family == 0x19;
#else
    return false;
#endif
}

__attribute__((constructor)) static void simd_begin(void)
{
    dyn_simd_use(vectors_halved() ? DYN_SIMD_AVX2 : DYN_SIMD_AVX512);
}

/* ---- what kernels report ---- */

static void snapped(struct dyn_job *job, int packed, double length)
{
    struct dyn_packed *s = &job->springs;
    const struct dyn_network *n = job->network;
    double rest = dyn_spring_row(n, SPRING_REST)[s->which[packed]] * n->world.rest;
    dyn_snap(job->network, s->which[packed], (length - rest) / rest, job->time_s);
    s->k[packed] = s->k_rest[packed] = s->c[packed] = 0;
    s->limit[packed] = INFINITY;
    job->stop = true;
}

static void pull(struct dyn_job *job)
{
    const struct dyn_network *n = job->network;
    for (int i = 0; i < n->pulls_count; i++) {
        const struct dyn_pull *p = &n->pulls[i];
        const struct dyn_state *s = &n->state[p->mass];
        double soft = n->prepared.pull_soft[i];
        double k = p->constant * soft, c = p->damping * soft;
        n->force[p->mass].x += k * (p->x - s->x) - c * s->vx;
        n->force[p->mass].y += k * (p->y - s->y) - c * s->vy;
    }
}

/* ---- steps ---- */

struct dyn_job dyn_job_make(struct dyn_network *n, int steps)
{
    const struct dyn_prepared *p = &n->prepared;
    const struct dyn_world *w = &n->world;
    return (struct dyn_job){
        .state = n->state,
        .force = n->force,
        .kick = p->kick,
        .keep = p->keep,
        .push_x = p->push_x,
        .push_y = p->push_y,
        .restitution = p->restitution,
        .friction = p->friction,
        .masses = (int)dyn_masses_padded(n->masses_count),
        .springs = p->springs,
        .h = p->h,
        .dt_s = p->dt_s,
        .least_x = w->left_on > 0 ? w->left : -DYN_EDGE,
        .most_x = w->right_on > 0 ? w->right : DYN_EDGE,
        .least_y = w->floor_on > 0 ? w->floor : -DYN_EDGE,
        .most_y = w->ceiling_on > 0 ? w->ceiling : DYN_EDGE,
        .slow_speed = 2 * p->h * fabs(w->gravity),
        .clank_speed = w->clank_speed,
        .speed_limit = w->speed_limit,
        .verlet = (int)w->integrator == DYN_VERLET,
        .parts = p->plan.parts,
        .steps = steps,
        .time_s = n->time_s,
        .network = n,
        .bounces = p->bounces,
        .bounce = dyn_bounces_make,
        .on_snap = snapped,
        .pull = n->pulls_count ? pull : NULL,
    };
}

static enum dyn_status step_check(double dt_s, int count)
{
    if (!(dt_s >= 1e-9 && dt_s <= 1))
        return dyn_fail(DYN_BAD_ARGUMENT, "a step must be 1e-9..1 s (got %g)", dt_s);
    if (count < 0)
        return dyn_fail(DYN_BAD_ARGUMENT, "the count of steps cannot be %d", count);
    return DYN_OK;
}

enum dyn_status dyn_network_step(struct dyn_network *n, double dt_s, int count)
{
    enum dyn_status status = step_check(dt_s, count);
    bool thesis = (int)n->world.integrator == DYN_THESIS;
    for (; thesis && status == DYN_OK && count > 0; count--) {
        dyn_thesis_step(n, dt_s);
        n->time_s += dt_s;
    }
    while (status == DYN_OK && count > 0) {
        status = dyn_prepare(n, dt_s);
        if (status != DYN_OK)
            break;
        struct dyn_job job = dyn_job_make(n, count);
        kernel(&job);
        n->time_s = job.time_s;
        count = job.steps;
    }
    return status;
}

enum dyn_status dyn_network_plan(struct dyn_network *n, double dt_s, struct dyn_plan *out)
{
    enum dyn_status status = step_check(dt_s, 0);
    if (status == DYN_OK)
        status = dyn_prepare(n, dt_s);
    if (status == DYN_OK)
        *out = n->prepared.plan;
    return status;
}
