/* fields_tables.c - prints the fields of event rows as Markdown tables, each after a line "==
 * NAME". */
#include <describe.h>

#include <sheet.h>

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

static double per_unit(const struct member *m)
{
    return m->per_unit != 0 ? m->per_unit : 1;
}

static void row_print(const struct member *m, int elements)
{
    const char *usual = m->usual ? m->usual : "", *help = m->help ? m->help : "";
    printf("| `%s` | ", m->field);
    if (m->kind == MEMBER_FLAG)
        printf("true, false");
    else
        printf("%s%.10g..%.10g",
               elements == PAPER_BANDS ? "ten numbers "
               : elements == 3         ? "`{r, g, b}` "
               : elements == 2         ? "`{a, b}` "
                                       : "",
               m->least * per_unit(m), m->most * per_unit(m));
    printf(" | %s | %s |\n", usual, help);
}

static void table_print(const char *name, const struct members *members)
{
    const struct member *end = members->first + members->count;
    printf("== %s\n| field | range | default | |\n|---|---|---|---|\n", name);
    for (const struct member *m = members->first; m < end; m++) {
        int elements = m->count;
        if (!m->field || m->element > 1)
            continue;
        while (m->element && m + elements < end && m[elements].element == elements + 1)
            elements++;
        row_print(m, m->kind == MEMBER_FLAG ? 1 : elements);
    }
}

/* Whether the rows' defaults are those of `usual`. */
static bool defaults_hold(const char *whose, const struct members *members, const void *usual)
{
    bool hold = true;
    for (size_t i = 0; i < members->count; i++) {
        const struct member *m = &members->first[i];
        double value = *(const double *)(const void *)((const char *)usual + m->offset);
        if (!m->usual || strtod(m->usual, NULL) == value)
            continue;
        fprintf(stderr, "%s's %s is %g, and its row says %s\n", whose, m->name, value,
                m->usual);
        hold = false;
    }
    return hold;
}

int main(void)
{
    table_print("paper", &paper_stock_members);
    table_print("deckle", &paper_deckle_members);
    table_print("pigment", &paper_pigment_members);
    table_print("bands", &paper_bands_members);
    table_print("air", &paper_air_members);
    table_print("brush", &paper_brush_members);
    table_print("dip", &paper_dip_members);
    table_print("splatter", &paper_splatter_members);
    table_print("salt", &paper_salt_members);
    const struct paper_air air = paper_air_default();
    const struct paper_deckle deckle = paper_deckle_default();
    const bool both = defaults_hold("air", &paper_air_members, &air) &&
                      defaults_hold("deckle", &paper_deckle_members, &deckle);
    return !both;
}
