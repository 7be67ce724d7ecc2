/* desk_main.c - the program lutetia-studio, which `lutetia studio` runs. Its words are of that
 * verb's making, NAME=VALUE, and have been checked there: file, play, fresh, width, height,
 * stock, pigment, seed, theme. */
#include "desk.h"

#include <stdlib.h>
#include <string.h>
#include <visible_text.h>

static bool word_take(void *context, const char *name, const char *value)
{
    struct desk_options *o = context;
    if (strcmp(name, "file") == 0)
        o->path = value;
    else if (strcmp(name, "play") == 0)
        o->play = value;
    else if (strcmp(name, "width") == 0)
        o->config.width = atoi(value);
    else if (strcmp(name, "height") == 0)
        o->config.height = atoi(value);
    else if (strcmp(name, "seed") == 0)
        o->config.seed = strtoull(value, NULL, 10);
    else if (strcmp(name, "stock") == 0 && paper_stock_find(value))
        o->config.stock = *paper_stock_find(value);
    else if (strcmp(name, "pigment") == 0 && paper_pigment_find(value) &&
             o->config.pigments_count < PAPER_PIGMENTS_MAX)
        o->config.pigments[o->config.pigments_count++] = *paper_pigment_find(value);
    else if (strcmp(name, "fresh") == 0)
        o->fresh = true;
    else if (strcmp(name, "theme") == 0)
        o->theme = strcmp(value, "dark") == 0;
    else
        return false;
    return true;
}

static void activate(GtkApplication *application, gpointer data)
{
    struct desk *d = data;
    (void)application;
    if (d->window)
        gtk_window_present(GTK_WINDOW(d->window));
    else
        desk_window_open(d);
}

static void desk_finish(struct desk *d)
{
    struct studio_report last = d->report;
    studio_paper_end(d->paper, d->closed, &last);
    if (last.errors != d->report.errors) { /* after the window was closed */
        visible_say("lutetia studio: %s", last.error);
        d->status = 1;
    }
    desk_pen_destroy(d->pen);
    desk_play_destroy(d->play);
    g_clear_object(&d->input_method);
    if (d->ghost)
        g_array_free(d->ghost, TRUE);
    if (d->typed)
        g_string_free(d->typed, TRUE);
    free(d->past.deeds);
    desk_beside_free(d);
    desk_springs_drop(d);
    studio_outlined_free(&d->outline);
    g_free(d->preedit);
    g_free(d->font);
    g_free(d->stamp);
    g_free(d->features);
}

int main(int argc, char **argv)
{
    struct desk *d = g_new0(struct desk, 1);
    d->options.config = paper_sheet_config_default();
    d->options.theme = -1;
    const int wrong = desk_frame_begin("studio", "", argc, argv, word_take, &d->options);
    if (wrong)
        return wrong;
    studio_settings_usual(&d->settings);
    if (d->options.play && !(d->play = desk_play_open(d, d->options.play)))
        return 1;
    d->application = gtk_application_new("org.lutetia.Studio", G_APPLICATION_NON_UNIQUE);
    const int status = desk_frame_run(d->application, argv, G_CALLBACK(activate), d);
    desk_finish(d);
    g_object_unref(d->application);
    const int own = d->status;
    g_free(d);
    return own ? own : status;
}
