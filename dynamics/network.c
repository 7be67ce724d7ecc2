/* network.c - see network.h. */
#include "internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct dyn_mass dyn_mass_usual(void)
{
    return (struct dyn_mass){.mass = 1, .gravity = 1, .restitution = 1, .friction = 1};
}

struct dyn_spring dyn_spring_usual(void)
{
    return (struct dyn_spring){.end = {-1, -1},
                               .constant = 100,
                               .rest_length = DYN_REST_AS_PLACED,
                               .breaking_strain = INFINITY};
}

bool dyn_array_reserve(void **array, size_t *capacity, size_t count, size_t element_bytes)
{
    if (count <= *capacity)
        return true;
    size_t wanted = *capacity ? 2 * *capacity : 32;
    while (wanted < count)
        wanted *= 2;
    void *grown = aligned_alloc(64, (wanted * element_bytes + 63) / 64 * 64);
    if (!grown)
        return false;
    if (*capacity)
        memcpy(grown, *array, *capacity * element_bytes);
    memset((char *)grown + *capacity * element_bytes, 0, (wanted - *capacity) * element_bytes);
    free(*array);
    *array = grown;
    *capacity = wanted;
    return true;
}

/* Grows rows that are in one block: each row moves when the block grows. */
static bool rows_reserve(double **rows, size_t *capacity, size_t count, int rows_count)
{
    if (count <= *capacity)
        return true;
    size_t wanted = *capacity ? 2 * *capacity : 32, row_bytes = *capacity * sizeof(double);
    while (wanted < count)
        wanted *= 2;
    double *grown = aligned_alloc(64, wanted * sizeof(double) * (size_t)rows_count);
    if (!grown)
        return false;
    memset(grown, 0, wanted * sizeof(double) * (size_t)rows_count);
    for (size_t row = 0; *capacity && row < (size_t)rows_count; row++)
        memcpy(grown + row * wanted, *rows + row * *capacity, row_bytes);
    free(*rows);
    *rows = grown;
    *capacity = wanted;
    return true;
}

static bool masses_reserve(struct dyn_network *n, int count)
{
    size_t padded = dyn_masses_padded(count);
    return padded <= DYN_MASSES_MOST &&
           rows_reserve(&n->mass_field, &n->masses_capacity, padded, MASS_PARAMETERS) &&
           dyn_array_reserve((void **)&n->state, &n->state_capacity, padded,
                             sizeof *n->state) &&
           dyn_array_reserve((void **)&n->force, &n->force_capacity, padded,
                             sizeof *n->force) &&
           dyn_array_reserve((void **)&n->hold, &n->holds_capacity, padded, 1) &&
           dyn_array_reserve((void **)&n->degree, &n->degree_capacity, padded,
                             sizeof *n->degree);
}

static bool springs_reserve(struct dyn_network *n, int count)
{
    size_t room = (size_t)count;
    return rows_reserve(&n->spring_field, &n->springs_capacity, room, SPRING_PARAMETERS) &&
           dyn_array_reserve((void **)&n->end, &n->ends_capacity, room, sizeof *n->end) &&
           dyn_array_reserve((void **)&n->broken, &n->flags_capacity, room, 1);
}

enum dyn_status dyn_network_create(struct dyn_network **out)
{
    struct dyn_network *n = calloc(1, sizeof *n);
    *out = n;
    if (!n)
        return dyn_fail(DYN_NO_MEMORY, "no memory for a network");
    n->world = dyn_world_usual();
    n->changed = true;
    if (!masses_reserve(n, 0)) {
        dyn_network_destroy(n);
        *out = NULL;
        return dyn_fail(DYN_NO_MEMORY, "no memory for a network");
    }
    return DYN_OK;
}

void dyn_network_destroy(struct dyn_network *n)
{
    if (!n)
        return;
    free(n->state);
    free(n->force);
    free(n->mass_field);
    free(n->hold);
    free(n->degree);
    free(n->end);
    free(n->spring_field);
    free(n->broken);
    free(n->events);
    dyn_prepared_finish(&n->prepared);
    free(n);
}

enum dyn_status dyn_network_copy_state(struct dyn_network *to, const struct dyn_network *from)
{
    size_t masses = (size_t)from->masses_count, springs = (size_t)from->springs_count;
    if (to == from)
        return DYN_OK;
    if (!masses_reserve(to, from->masses_count) || !springs_reserve(to, from->springs_count))
        return dyn_fail(DYN_NO_MEMORY, "no memory for a copy of %d masses and %d springs",
                        from->masses_count, from->springs_count);
    to->world = from->world;
    to->time_s = from->time_s;
    to->masses_count = from->masses_count;
    to->springs_count = from->springs_count;
    memset(to->state, 0, to->state_capacity * sizeof *to->state);
    memcpy(to->state, from->state, masses * sizeof *to->state);
    memcpy(to->hold, from->hold, masses);
    memcpy(to->degree, from->degree, masses * sizeof *to->degree);
    for (int row = 0; row < MASS_PARAMETERS; row++)
        memcpy(dyn_mass_row(to, row), dyn_mass_row(from, row), masses * sizeof(double));
    for (int row = 0; springs && row < SPRING_PARAMETERS; row++)
        memcpy(dyn_spring_row(to, row), dyn_spring_row(from, row), springs * sizeof(double));
    if (springs) {
        memcpy(to->end, from->end, springs * sizeof *to->end);
        memcpy(to->broken, from->broken, springs);
    }
    memcpy(to->pulls, from->pulls, sizeof to->pulls);
    to->pulls_count = from->pulls_count;
    to->changed = true;
    return DYN_OK;
}

enum dyn_status dyn_network_copy(struct dyn_network *to, const struct dyn_network *from)
{
    if (to == from)
        return DYN_OK;
    if (from->events && !to->events)
        to->events = malloc(DYN_EVENTS_MAX * sizeof *to->events);
    if (from->events && !to->events)
        return dyn_fail(DYN_NO_MEMORY, "no memory for a copy of a network's events");
    const enum dyn_status status = dyn_network_copy_state(to, from);
    if (status != DYN_OK)
        return status;
    if (from->events)
        memcpy(to->events, from->events, DYN_EVENTS_MAX * sizeof *to->events);
    to->events_first = from->events_first;
    to->events_count = from->events_count;
    to->events_lost = from->events_lost;
    return DYN_OK;
}

/* ---- masses and springs ---- */

static enum dyn_status mass_look(const struct dyn_mass *mass)
{
    if (mass->hold > (DYN_STUCK | DYN_HELD))
        return dyn_fail(DYN_BAD_ARGUMENT, "a mass is free, stuck or held (got %u)", mass->hold);
    return dyn_controls_check(dyn_mass_fields, dyn_mass_fields_count, mass);
}

void dyn_mass_put(struct dyn_network *n, int index, const struct dyn_mass *mass)
{
    n->state[index] = (struct dyn_state){mass->x, mass->y, mass->vx, mass->vy};
    dyn_mass_row(n, MASS_MASS)[index] = mass->mass;
    dyn_mass_row(n, MASS_DRAG)[index] = mass->drag;
    dyn_mass_row(n, MASS_GRAVITY)[index] = mass->gravity;
    dyn_mass_row(n, MASS_RESTITUTION)[index] = mass->restitution;
    dyn_mass_row(n, MASS_FRICTION)[index] = mass->friction;
    n->hold[index] = (uint8_t)mass->hold;
    n->changed = true;
}

enum dyn_status dyn_mass_add(struct dyn_network *n, const struct dyn_mass *mass, int *index)
{
    enum dyn_status status = mass_look(mass);
    if (status != DYN_OK)
        return status;
    if (n->masses_count == DYN_MASSES_MAX)
        return dyn_fail(DYN_TOO_LARGE, "a network has at most %d masses", DYN_MASSES_MAX);
    if (!masses_reserve(n, n->masses_count + 1))
        return dyn_fail(DYN_NO_MEMORY, "no memory for %d masses", n->masses_count + 1);
    dyn_mass_put(n, n->masses_count, mass);
    n->degree[n->masses_count] = 0;
    if (index)
        *index = n->masses_count;
    n->masses_count++;
    return DYN_OK;
}

static double length_between(const struct dyn_network *n, int a, int b)
{
    double dx = n->state[b].x - n->state[a].x, dy = n->state[b].y - n->state[a].y;
    return sqrt(dx * dx + dy * dy);
}

void dyn_spring_put(struct dyn_network *n, int index, const struct dyn_spring *spring)
{
    dyn_spring_row(n, SPRING_CONSTANT)[index] = spring->constant;
    dyn_spring_row(n, SPRING_REST)[index] = spring->rest_length;
    dyn_spring_row(n, SPRING_DAMPING)[index] = spring->damping;
    dyn_spring_row(n, SPRING_BREAKING)[index] = spring->breaking_strain;
    n->broken[index] = spring->broken;
    n->changed = true;
}

enum dyn_status dyn_spring_add(struct dyn_network *n, const struct dyn_spring *spring,
                               int *index)
{
    struct dyn_spring s = *spring;
    int a = s.end[0], b = s.end[1];
    for (int i = 0; i < 2; i++)
        if (s.end[i] < 0 || s.end[i] >= n->masses_count)
            return dyn_fail(DYN_BAD_ARGUMENT,
                            "a spring needs two masses, and there is no mass %d (of %d)",
                            s.end[i], n->masses_count);
    if (a == b)
        return dyn_fail(DYN_BAD_ARGUMENT, "a spring cannot go from mass %d to itself", a);
    if (s.rest_length == DYN_REST_AS_PLACED)
        s.rest_length = length_between(n, a, b);
    enum dyn_status status = dyn_controls_check(dyn_spring_fields, dyn_spring_fields_count, &s);
    if (status != DYN_OK)
        return status;
    if (n->springs_count == DYN_SPRINGS_MAX)
        return dyn_fail(DYN_TOO_LARGE, "a network has at most %d springs", DYN_SPRINGS_MAX);
    for (int i = 0; i < 2; i++)
        if (n->degree[s.end[i]] == DYN_DEGREE_MAX)
            return dyn_fail(DYN_TOO_LARGE, "mass %d has %d springs, and a mass has no more",
                            s.end[i], DYN_DEGREE_MAX);
    if (!springs_reserve(n, n->springs_count + 1))
        return dyn_fail(DYN_NO_MEMORY, "no memory for %d springs", n->springs_count + 1);
    n->end[n->springs_count][0] = a;
    n->end[n->springs_count][1] = b;
    n->degree[a]++;
    n->degree[b]++;
    dyn_spring_put(n, n->springs_count, &s);
    if (index)
        *index = n->springs_count;
    n->springs_count++;
    return DYN_OK;
}

void dyn_network_truncate(struct dyn_network *n, int masses_count, int springs_count)
{
    int kept = 0;
    memset(n->degree, 0, n->degree_capacity * sizeof *n->degree);
    for (int i = 0; i < springs_count; i++) {
        struct dyn_spring spring = dyn_spring_get(n, i);
        if (spring.end[0] >= masses_count || spring.end[1] >= masses_count)
            continue;
        memcpy(n->end[kept], spring.end, sizeof spring.end);
        dyn_spring_put(n, kept++, &spring);
        n->degree[spring.end[0]]++;
        n->degree[spring.end[1]]++;
    }
    n->springs_count = kept;
    for (int i = n->pulls_count - 1; i >= 0; i--)
        if (n->pulls[i].mass >= masses_count)
            memmove(&n->pulls[i], &n->pulls[i + 1],
                    (size_t)(--n->pulls_count - i) * sizeof *n->pulls);
    for (int i = masses_count; i < n->masses_count; i++)
        n->state[i] = (struct dyn_state){0};
    n->masses_count = masses_count;
    n->changed = true;
}

int dyn_masses_count(const struct dyn_network *n)
{
    return n->masses_count;
}

int dyn_springs_count(const struct dyn_network *n)
{
    return n->springs_count;
}

struct dyn_mass dyn_mass_get(const struct dyn_network *n, int index)
{
    const struct dyn_state *s = &n->state[index];
    return (struct dyn_mass){.x = s->x,
                             .y = s->y,
                             .vx = s->vx,
                             .vy = s->vy,
                             .mass = dyn_mass_row(n, MASS_MASS)[index],
                             .drag = dyn_mass_row(n, MASS_DRAG)[index],
                             .gravity = dyn_mass_row(n, MASS_GRAVITY)[index],
                             .restitution = dyn_mass_row(n, MASS_RESTITUTION)[index],
                             .friction = dyn_mass_row(n, MASS_FRICTION)[index],
                             .hold = n->hold[index]};
}

struct dyn_spring dyn_spring_get(const struct dyn_network *n, int index)
{
    return (struct dyn_spring){.end = {n->end[index][0], n->end[index][1]},
                               .constant = dyn_spring_row(n, SPRING_CONSTANT)[index],
                               .rest_length = dyn_spring_row(n, SPRING_REST)[index],
                               .damping = dyn_spring_row(n, SPRING_DAMPING)[index],
                               .breaking_strain = dyn_spring_row(n, SPRING_BREAKING)[index],
                               .broken = n->broken[index]};
}

enum dyn_status dyn_mass_set(struct dyn_network *n, int index, const struct dyn_mass *mass)
{
    enum dyn_status status = dyn_mass_check(n, index);
    if (status == DYN_OK)
        status = mass_look(mass);
    if (status == DYN_OK)
        dyn_mass_put(n, index, mass);
    return status;
}

enum dyn_status dyn_spring_set(struct dyn_network *n, int index,
                               const struct dyn_spring *spring)
{
    struct dyn_spring s = *spring;
    enum dyn_status status = dyn_spring_check(n, index);
    if (status != DYN_OK)
        return status;
    if (s.rest_length == DYN_REST_AS_PLACED)
        s.rest_length = length_between(n, n->end[index][0], n->end[index][1]);
    status = dyn_controls_check(dyn_spring_fields, dyn_spring_fields_count, &s);
    if (status == DYN_OK)
        dyn_spring_put(n, index, &s);
    return status;
}

const struct dyn_state *dyn_network_states(const struct dyn_network *n)
{
    return n->state;
}

double dyn_spring_strain(const struct dyn_network *n, int index)
{
    double rest = dyn_spring_row(n, SPRING_REST)[index] * n->world.rest;
    if (n->broken[index] || !(rest > 0))
        return 0;
    return (length_between(n, n->end[index][0], n->end[index][1]) - rest) / rest;
}

/* ---- what all have in common ---- */

const struct dyn_world *dyn_network_world(const struct dyn_network *n)
{
    return &n->world;
}

enum dyn_status dyn_network_world_set(struct dyn_network *n, const struct dyn_world *world)
{
    enum dyn_status status = dyn_controls_check(dyn_controls, dyn_controls_count, world);
    if (status == DYN_OK) {
        n->world = *world;
        n->changed = true;
    }
    return status;
}

double dyn_network_time_s(const struct dyn_network *n)
{
    return n->time_s;
}

void dyn_network_time_set(struct dyn_network *n, double time_s)
{
    n->time_s = time_s;
}
