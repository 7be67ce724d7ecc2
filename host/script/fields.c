/* fields.c - reads the fields of a table of options by rows of members, which give their
 * names and ranges. */
#include "script_internal.h"

#include <limits.h>
#include <math.h>
#include <string.h>

enum { NAMES_MAX = 64, ELEMENTS_MAX = 10 };

void script_fields_options(lua_State *L, int index, const char *what,
                           const struct members *members, const char *const *besides)
{
    const char *names[NAMES_MAX + 1];
    int count = 0;
    for (size_t i = 0; i < members->count && count < NAMES_MAX; i++)
        if (members->first[i].field && members->first[i].element <= 1)
            names[count++] = members->first[i].field;
    for (int i = 0; besides && besides[i] && count < NAMES_MAX; i++)
        names[count++] = besides[i];
    names[count] = NULL;
    script_arg_options(L, index, what, names);
}

static double per_unit(const struct member *m)
{
    return m->per_unit != 0 ? m->per_unit : 1;
}

static void number_store(const struct member *m, int at, void *of, double value)
{
    void *start = (char *)of + m->offset;
    if (m->kind == MEMBER_INT)
        ((int *)start)[at] = (int)value;
    else
        ((double *)start)[at] = value / per_unit(m);
}

/* Reads a field that is one member: a number, an integer, a boolean, or several numbers. */
static void member_read(lua_State *L, int index, const char *what, const struct member *m,
                        void *of)
{
    double least = m->least * per_unit(m), most = m->most * per_unit(m), value,
           values[ELEMENTS_MAX];
    bool *flag = (bool *)((char *)of + m->offset);
    if (m->kind == MEMBER_FLAG) {
        *flag = script_arg_boolean(L, index, what, m->field, *flag);
    } else if (m->kind == MEMBER_INT) {
        int whole = script_arg_integer(L, index, what, m->field, INT_MIN, least, most);
        if (whole != INT_MIN)
            number_store(m, 0, of, whole);
    } else if (m->count == 1) {
        value = script_arg_number(L, index, what, m->field, NAN, least, most);
        if (!isnan(value))
            number_store(m, 0, of, value);
    } else if (script_arg_numbers(L, index, what, m->field, values, m->count, least, most)) {
        for (int i = 0; i < m->count; i++)
            number_store(m, i, of, values[i]);
    }
}

void script_fields_read(lua_State *L, int index, const char *what,
                        const struct members *members, void *of)
{
    const struct member *end = members->first + members->count;
    for (const struct member *m = members->first; m < end; m++) {
        double values[ELEMENTS_MAX];
        int count = 0;
        if (!m->field)
            continue;
        if (m->element == 0) {
            member_read(L, index, what, m, of);
            continue;
        }
        while (m + count < end && m[count].element == count + 1 && count < ELEMENTS_MAX)
            count++;
        if (script_arg_numbers(L, index, what, m->field, values, count, m->least * per_unit(m),
                               m->most * per_unit(m)))
            for (int i = 0; i < count; i++)
                number_store(&m[i], 0, of, values[i]);
        m += count - 1;
    }
}

double script_member_at(lua_State *L, int index, const char *what,
                        const struct members *members, const char *name, double fallback)
{
    const struct member *m = members->first, *end = m + members->count;
    while (m < end && (!m->name || strcmp(m->name, name) != 0))
        m++;
    if (m == end)
        luaL_error(L, "there is no row '%s'", name); /* a mistake of the caller's */
    return lua_isnoneornil(L, index) && !isnan(fallback)
               ? fallback
               : script_arg_at(L, index, what, m->least, m->most);
}
