/* font_typeface.c - `lutetia font FILE --typeface PX`: all glyphs at a size in one picture, and
 * a table of where each is. */
#include "font_verb.h"
#include "help.h"
#include "lutetia.h"
#include "type_common.h"

#include <output_file.h>
#include <typeface.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool go_on(void *progress, int done, int count)
{
    struct progress *p = progress;
    p->total = count;
    progress_show(p, done);
    return !interrupted();
}

/* A name in quotes, in which quotes are doubled. */
static void name_print(FILE *to, const char *name)
{
    fputc('"', to);
    for (; *name; name++) {
        if (*name == '"')
            fputc('"', to);
        fputc(*name, to);
    }
    fputc('"', to);
}

static void table_print(FILE *to, const struct font_face *face, const struct font_typeface *t)
{
    char name[FONT_GLYPH_NAME_BYTES];
    fputs("glyph,name,character,x,y,width,height,left,top,advance\r\n", to);
    for (int i = 0; i < t->glyphs_count; i++) {
        const struct font_typeface_glyph *g = &t->glyphs[i];
        fprintf(to, "%u,", g->glyph);
        name_print(to, font_face_glyph_name(face, g->glyph, name));
        if (g->character)
            fprintf(to, ",U+%04X", g->character);
        else
            fputc(',', to);
        fprintf(to, ",%d,%d,%d,%d,%d,%d,%.4f\r\n", g->x, g->y, g->width_px, g->height_px,
                g->left_px, g->top_px, g->advance_px);
    }
}

static int table_write(const char *path, const struct font_face *face,
                       const struct font_typeface *t)
{
    struct output_file out;
    if (!output_file_open(&out, path))
        return fail("font", "%s: cannot write: %s", path, out.why);
    table_print(out.stream, face, t);
    return output_file_commit(&out) ? EXIT_SUCCESS
                                    : fail("font", "%s: cannot write: %s", path, out.why);
}

/* The picture's name with .csv in place of .png. Owns: the caller; NULL: no memory. */
static char *table_path(const char *picture)
{
    const size_t n = strlen(picture);
    const bool png = n > 4 && strcmp(picture + n - 4, ".png") == 0;
    char *path;
    return asprintf(&path, "%.*s.csv", (int)(png ? n - 4 : n), picture) < 0 ? NULL : path;
}

static int files_write(const struct font_verb *v, const struct font_face *face,
                       const struct font_typeface *t)
{
    const struct display_image image = {t->width_px, t->height_px, 1, t->pixels};
    char *path = table_path(v->out_path);
    if (!path)
        return fail("font", "no memory for a name");
    int status = table_write(path, face, t);
    if (status == EXIT_SUCCESS && display_png_write(v->out_path, &image) != DISPLAY_OK)
        status = fail("font", "%s", display_error());
    if (status == EXIT_SUCCESS)
        tell("font", "wrote %s and %s", v->out_path, path);
    free(path);
    return status;
}

int font_typeface_show(const struct font_verb *v, struct font_face *face)
{
    struct progress progress = progress_begin("font", 0);
    const struct font_typeface_def def = {
        .size_px = v->typeface_px, .filter = v->filter, .go_on = go_on, .context = &progress};
    struct font_typeface t;
    int status = output_check("font", v->out_path);
    if (status != EXIT_SUCCESS)
        return status;
    interrupt_catch();
    const double began_s = seconds_now();
    const enum font_status drawn = font_typeface_draw(face, &def, &t);
    progress_end(&progress);
    if (interrupted()) {
        font_typeface_finish(&t);
        return interrupt_report("font", EXIT_INTERRUPTED, "the files are");
    }
    if (drawn != FONT_OK)
        return fail_font("font");
    printf("%d glyphs with ink at %g pixels in %.3f s", t.inked_count, v->typeface_px,
           seconds_now() - began_s);
    if (*t.device)
        printf(", %d of them on %s", t.on_device_count, t.device);
    printf("; %dx%d pixels\n", t.width_px, t.height_px);
    status = t.inked_count
                 ? files_write(v, face, &t)
                 : fail("font", "%s: no glyph of it has an outline with ink", v->file);
    type_left_out_tell("font");
    font_typeface_finish(&t);
    return status;
}
