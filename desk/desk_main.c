/* desk_main.c - the program lutetia-studio, which `lutetia studio` runs. Its words are of that
 * verb's making, NAME=VALUE, and have been checked there: file, play, fresh, width, height,
 * stock, pigment, seed, theme. */
#include "desk.h"

#include <locale.h>
#include <stdlib.h>
#include <string.h>
#include <visible_text.h>

static bool word_take(struct desk_options *o, const char *word)
{
    const char *value = strchr(word, '=');
    const size_t length = value ? (size_t)(value - word) : 0;
    if (!value)
        return false;
    value++;
#define IS(name) (length == strlen(name) && strncmp(word, name, length) == 0)
    if (IS("file"))
        o->path = value;
    else if (IS("play"))
        o->play = value;
    else if (IS("width"))
        o->config.width = atoi(value);
    else if (IS("height"))
        o->config.height = atoi(value);
    else if (IS("seed"))
        o->config.seed = strtoull(value, NULL, 10);
    else if (IS("stock") && paper_stock_find(value))
        o->config.stock = *paper_stock_find(value);
    else if (IS("pigment") && paper_pigment_find(value) &&
             o->config.pigments_count < PAPER_PIGMENTS_MAX)
        o->config.pigments[o->config.pigments_count++] = *paper_pigment_find(value);
    else if (IS("fresh"))
        o->fresh = true;
    else if (IS("theme"))
        o->theme = strcmp(value, "dark") == 0;
    else
        return false;
#undef IS
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
    g_free(d->preedit);
    g_free(d->font);
    g_free(d->features);
}

int main(int argc, char **argv)
{
    struct desk *d = g_new0(struct desk, 1);
    setlocale(LC_ALL, "");
    setlocale(LC_NUMERIC, "C"); /* numbers in files and scripts have points */
    bindtextdomain("lutetia", LUTETIA_LOCALEDIR);
    bind_textdomain_codeset("lutetia", "UTF-8");
    textdomain("lutetia");
    d->options.config = paper_sheet_config_default();
    d->options.theme = -1;
    for (int i = 1; i < argc; i++)
        if (!word_take(&d->options, argv[i])) {
            visible_say("lutetia-studio: `lutetia studio` runs this program");
            return 2;
        }
    studio_settings_usual(&d->settings);
    gtk_disable_setlocale();
    if (!gtk_init_check()) {
        visible_say("lutetia studio: no display; run it where there is a desktop, or set "
                    "DISPLAY or WAYLAND_DISPLAY");
        return 1;
    }
    if (d->options.play && !(d->play = desk_play_open(d, d->options.play)))
        return 1;
    d->application = gtk_application_new("org.lutetia.Studio", G_APPLICATION_NON_UNIQUE);
    g_signal_connect(d->application, "activate", G_CALLBACK(activate), d);
    const int status = g_application_run(G_APPLICATION(d->application), 1, argv);
    desk_finish(d);
    g_object_unref(d->application);
    const int own = d->status;
    g_free(d);
    return own ? own : status;
}
