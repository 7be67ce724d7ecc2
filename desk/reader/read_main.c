/* read_main.c - the program lutetia-reader, which `lutetia read` runs. Its words are of that
 * verb's making, NAME=VALUE, and have been checked there: file (in their order), font, mono,
 * math, language, size, width, height, theme, ragged, template, play; manual: the files are the
 * manual. */
#include "read_desk.h"

#include <stdlib.h>
#include <string.h>
#include <visible_text.h>

static bool word_take(void *context, const char *name, const char *value)
{
    struct read_options *o = context;
    if (strcmp(name, "file") == 0)
        g_ptr_array_add(o->paths, g_strdup(value));
    else if (strcmp(name, "font") == 0)
        o->font = value;
    else if (strcmp(name, "mono") == 0)
        o->mono = value;
    else if (strcmp(name, "math") == 0)
        o->math = value;
    else if (strcmp(name, "language") == 0)
        o->language = value;
    else if (strcmp(name, "size") == 0)
        o->size_px = g_ascii_strtod(value, NULL);
    else if (strcmp(name, "width") == 0)
        o->width = atoi(value);
    else if (strcmp(name, "height") == 0)
        o->height = atoi(value);
    else if (strcmp(name, "theme") == 0)
        o->theme = strcmp(value, "dark") == 0;
    else if (strcmp(name, "ragged") == 0)
        o->ragged = true;
    else if (strcmp(name, "manual") == 0)
        o->manual = g_ptr_array_ref(o->paths);
    else if (strcmp(name, "template") == 0)
        o->template = value;
    else if (strcmp(name, "play") == 0)
        o->play = value;
    else
        return false;
    return true;
}

static void activate(GtkApplication *application, gpointer data)
{
    struct read_desk *d = data;
    (void)application;
    if (d->window)
        gtk_window_present(GTK_WINDOW(d->window));
    else
        read_window_open(d);
}

static void desk_begin(struct read_desk *d)
{
    d->setup = reader_pages_setup_default();
    d->setup.width_px = d->options.width;
    d->setup.height_px = d->options.height;
    d->size_px = d->options.size_px;
    d->grid_edge = -1;
    d->grid_past = g_array_new(FALSE, FALSE, sizeof(struct reader_template));
    d->hits = g_array_new(FALSE, FALSE, sizeof(struct read_range));
    d->way = g_array_new(FALSE, FALSE, sizeof(struct read_place));
    d->heard = g_ptr_array_new();
    d->stroke = g_array_new(FALSE, FALSE, sizeof(struct reader_ink_point));
    d->spots = g_array_new(FALSE, FALSE, 2 * sizeof(double));
    d->watches = g_ptr_array_new_with_free_func(g_object_unref);
    d->ink_rgba = 0x1f4fbfc8u; /* blue, translucent */
    d->ink_width = 0.16;
    d->chosen = g_array_new(FALSE, FALSE, sizeof(int));
    d->pressure = 1;
    d->hit = -1;
    d->focused = G_MAXSIZE;
    d->tiles = read_tiles_create();
    d->stages = read_stages_create(d);
    d->editing = read_edit_create();
}

static void desk_finish(struct read_desk *d)
{
    read_heard_finish(d);
    read_play_destroy(d->play);
    read_watch_end(d);
    read_edit_destroy(d->editing);
    read_remarks_finish(d);
    read_document_finish(d);
    desk_pen_destroy(d->pen);
    g_array_free(d->stroke, TRUE);
    g_array_free(d->spots, TRUE);
    g_array_free(d->chosen, TRUE);
    g_array_free(d->grid_past, TRUE);
    g_ptr_array_unref(d->watches);
    read_stages_finish(d);
    read_stages_destroy(d->stages);
    read_miniatures_destroy(d);
    read_tiles_destroy(d->tiles);
    g_array_free(d->hits, TRUE);
    g_ptr_array_unref(d->heard);
    g_ptr_array_unref(d->options.paths);
    if (d->options.manual)
        g_ptr_array_unref(d->options.manual);
}

int main(int argc, char **argv)
{
    struct read_desk *d = g_new0(struct read_desk, 1);
    d->options = (struct read_options){.paths = g_ptr_array_new_with_free_func(g_free),
                                       .size_px = 17,
                                       .width = 1000,
                                       .height = 800,
                                       .theme = -1};
    const int wrong = desk_frame_begin("read", ", or write pages with -o FILE", argc, argv,
                                       word_take, &d->options);
    if (wrong)
        return wrong;
    if (!d->options.paths->len) {
        visible_say("lutetia read: `lutetia read` runs this program, with a file");
        return 2;
    }
    if (reader_template_open(d->options.template ? d->options.template : "screen",
                             &d->template) != READER_OK) {
        visible_say("lutetia read: %s", reader_error());
        return 1;
    }
    desk_begin(d);
    if (d->options.play && !(d->play = read_play_open(d, d->options.play)))
        return 1;
    d->application = gtk_application_new("org.lutetia.Reader", G_APPLICATION_NON_UNIQUE);
    const int status = desk_frame_run(d->application, argv, G_CALLBACK(activate), d);
    desk_finish(d);
    g_object_unref(d->application);
    const int own = d->status;
    g_free(d);
    return own ? own : status;
}
