/* print.c - fields as text on the standard output, for programs without a debugger.
 *
 *     heat: 32 bits, VP set 2: 4 x 6
 *     0 |      0  0.375 (0.75)        a row for each line along the last axis; what is inactive is in parentheses
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "machine_inside.h"
#include "paris_state.h"

enum { ROWS_MOST = 64, COLUMNS_MOST = 16, CELL = 48 };

/* A value as text: bits of `bits` from the lowest, a float's as float or double. */
static void value_print(char *out, size_t size, struct paris_operand a,
                        struct machine_type type, const uint8_t *at, bool active)
{
    struct machine_scalar x = {0, 0};
    float single = 0;
    double number = 0;
    char text[CELL];
    const size_t element = machine_element_bytes(type);
    memcpy(&x.lo, at, element < 8 ? element : 8);
    if (element > 8)
        memcpy(&x.hi, at + 8, 8);
    if (a.letter == 'f') {
        memcpy(&single, at, sizeof single);
        memcpy(&number, &x.lo, sizeof number);
        snprintf(text, sizeof text, "%.*g", element == 4 ? 7 : 12,
                 element == 4 ? (double)single : number);
    } else if (a.letter == 's' && a.len <= 64 && x.lo >> (a.len - 1)) {
        snprintf(text, sizeof text, "%lld",
                 (long long)(x.lo | (a.len < 64 ? ~(uint64_t)0 << a.len : 0)));
    } else if (x.hi) {
        snprintf(text, sizeof text, "0x%llx%016llx", (unsigned long long)x.hi,
                 (unsigned long long)x.lo);
    } else {
        snprintf(text, sizeof text, "%llu", (unsigned long long)x.lo);
    }
    snprintf(out, size, active ? "%s" : "(%s)", text);
}

struct printed {
    struct paris_operand operand;
    struct machine_type type;
    const uint8_t *values, *active;
    const struct paris_geometry *geometry;
};

static void row_print(const struct printed *p, uint64_t row, uint64_t columns, int broad)
{
    const size_t element = machine_element_bytes(p->type);
    const int axes = p->geometry->rank - 1;
    uint64_t left = row;
    int place[MACHINE_AXES_MAX];
    char text[CELL + 2];
    for (int axis = axes - 1; axis >= 0; axis--) {
        place[axis] = (int)(left % (uint64_t)p->geometry->dimensions[axis]);
        left /= (uint64_t)p->geometry->dimensions[axis];
    }
    for (int axis = 0; axis < axes; axis++)
        printf("%d ", place[axis]);
    printf("|");
    for (uint64_t column = 0; column < columns && column < COLUMNS_MOST; column++) {
        const uint64_t i = row * columns + column;
        value_print(text, sizeof text, p->operand, p->type, p->values + i * element,
                    p->active[i]);
        printf(" %*s", broad, text);
    }
    printf(columns > COLUMNS_MOST ? " ...\n" : "\n");
}

static void all_print(const struct printed *p)
{
    const struct paris_geometry *g = p->geometry;
    const uint64_t columns = (uint64_t)g->dimensions[g->rank - 1], rows = g->count / columns;
    const size_t element = machine_element_bytes(p->type);
    int broad = 1;
    char text[CELL + 2];
    for (uint64_t row = 0; row < rows && row < ROWS_MOST; row++)
        for (uint64_t column = 0; column < columns && column < COLUMNS_MOST; column++) {
            const uint64_t i = row * columns + column;
            value_print(text, sizeof text, p->operand, p->type, p->values + i * element,
                        p->active[i]);
            broad = (int)strlen(text) > broad ? (int)strlen(text) : broad;
        }
    for (uint64_t row = 0; row < rows && row < ROWS_MOST; row++)
        row_print(p, row, columns, broad);
    if (rows > ROWS_MOST)
        printf("... %llu rows\n", (unsigned long long)rows);
}

static void title_print(const char *what, const struct paris_geometry *g)
{
    printf("%s, VP set %d:", what, CM_current_vp_set);
    for (int axis = 0; axis < g->rank; axis++)
        printf(axis ? " x %d" : " %d", g->dimensions[axis]);
    printf("\n");
}

static void field_print(const char *name, struct paris_operand a)
{
    struct machine *m = paris_begin(name);
    struct machine_type type = MACHINE_BIT;
    char title[80];
    if (!paris_type(a, "source", &type) ||
        !paris_check_field(a.field, paris_operand_bits(a), "source"))
        return;
    const struct paris_geometry *g = paris_geometry_current();
    uint8_t *active = malloc(g->count),
            *values = malloc(g->count * machine_element_bytes(type));
    if (!active || !values)
        paris_fail_memory("not enough memory to print a field");
    else if (machine_flag_download(m, CM_current_vp_set, MACHINE_CONTEXT, active) ||
             machine_field_download(m, a.field, type, values))
        paris_fail_machine();
    else {
        snprintf(title, sizeof title, "field %u, %u bits", a.field, paris_operand_bits(a));
        title_print(title, g);
        all_print(&(struct printed){a, type, values, active, g});
    }
    free(active);
    free(values);
}

void CM_u_print_field_1L(CM_field_id_t source, unsigned int len)
{
    field_print("CM_u_print_field_1L", paris_u(source, len));
}

void CM_s_print_field_1L(CM_field_id_t source, unsigned int len)
{
    field_print("CM_s_print_field_1L", paris_s(source, len));
}

void CM_f_print_field_1L(CM_field_id_t source, unsigned int s, unsigned int e)
{
    field_print("CM_f_print_field_1L", paris_f(source, s, e));
}

void CM_print_context(void)
{
    struct machine *m = paris_begin("CM_print_context");
    const struct paris_geometry *g = paris_geometry_current();
    uint8_t *active = malloc(g->count), *all = active ? malloc(g->count) : NULL;
    if (!all)
        paris_fail_memory("not enough memory to print the context");
    else if (machine_flag_download(m, CM_current_vp_set, MACHINE_CONTEXT, active))
        paris_fail_machine();
    else {
        memset(all, 1, g->count);
        title_print("context", g);
        all_print(&(struct printed){paris_u(0, 1), MACHINE_BIT, active, all, g});
    }
    free(active);
    free(all);
}
