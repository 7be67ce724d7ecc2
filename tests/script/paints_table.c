/* paints_table.c - prints the table of paints as Markdown, after a line "== paints". */
#include <sheet.h>

#include <stdio.h>

int main(void)
{
    const struct paper_paint *paint;
    printf("== paints\n| name | also | Colour Index | spectrum | staining | granulation | "
           "particles, µm | "
           "transparency | drying shift |\n|---|---|---|---|---|---|---|---|---|\n");
    for (int i = 0; (paint = paper_paint_number(i)); i++)
        printf("| %s | %s | %s | %s | %g | %g | %g | %g | %g |\n", paint->pigment.name,
               paint->also, paint->index, paint->source, paint->pigment.staining,
               paint->pigment.granulation, paint->particle_um, paint->transparency,
               paint->pigment.shift);
    return 0;
}
