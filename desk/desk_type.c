/* desk_type.c - type that is typed straight on the sheet, with the input method of the desktop.
 * Until it is let into the paper it is a stencil that can be changed and moved; text that the
 * input method composes (preedit) is shown in its place. */
#include "desk.h"

#include <string.h>

/* ---- showing ---- */

static struct studio_message type_message(struct desk *d, enum studio_message_kind kind,
                                          bool composed)
{
    return (struct studio_message){
        .kind = kind,
        .text = g_strconcat(d->typed->str, composed && d->preedit ? d->preedit : "", NULL),
        .font = g_strdup(d->font),
        .features = g_strdup(d->features ? d->features : ""),
        .type_x = d->type_x,
        .type_y = d->type_y};
}

void desk_type_changed(struct desk *d)
{
    desk_springs_drop(d);
    if (d->paper && d->typing)
        studio_paper_send(d->paper, type_message(d, STUDIO_MESSAGE_TYPE_SHOW, true));
}

static void caret_tell(struct desk *d)
{
    const struct studio_place at = studio_view_to_canvas(&d->view, d->type_x, d->type_y);
    const double size = d->view.zoom * d->settings.value[STUDIO_TYPE_SIZE];
    gtk_im_context_set_cursor_location(
        d->input_method, &(GdkRectangle){(int)at.x, (int)(at.y - size), 1, (int)(1.2 * size)});
}

void desk_type_begin(struct desk *d, double x, double y)
{
    d->type_x = x;
    d->type_y = y;
    if (!d->typing) {
        g_string_truncate(d->typed, 0);
        d->typing = true;
        gtk_im_context_focus_in(d->input_method);
    }
    caret_tell(d);
    desk_type_changed(d);
}

static void type_end(struct desk *d)
{
    gtk_im_context_reset(d->input_method);
    gtk_im_context_focus_out(d->input_method);
    g_string_truncate(d->typed, 0);
    g_free(d->preedit);
    d->preedit = NULL;
    desk_type_changed(d); /* nothing is shown any more */
    d->typing = false;
}

void desk_type_print(struct desk *d)
{
    if (!d->typing)
        return;
    if (d->springs)
        desk_springs_print(d);
    else if (d->typed->str[strspn(d->typed->str, " \n\t")])
        studio_paper_send(d->paper, type_message(d, STUDIO_MESSAGE_TYPE, false));
    type_end(d);
}

void desk_type_drop(struct desk *d)
{
    if (d->typing)
        type_end(d);
}

/* ---- typing ---- */

void desk_type_text(struct desk *d, const char *text)
{
    if (!d->typing || d->springs) /* what flies is not changed */
        return;
    g_string_append(d->typed, text);
    desk_type_changed(d);
}

static void commit(GtkIMContext *context, const char *text, struct desk *d)
{
    (void)context;
    desk_type_text(d, text);
}

static void preedit(GtkIMContext *context, struct desk *d)
{
    g_free(d->preedit);
    gtk_im_context_get_preedit_string(context, &d->preedit, NULL, NULL);
    if (!d->springs)
        desk_type_changed(d);
}

static void back(struct desk *d)
{
    if (d->springs)
        return;
    if (d->typed->len > 0)
        g_string_truncate(
            d->typed, (gsize)(g_utf8_prev_char(d->typed->str + d->typed->len) - d->typed->str));
    desk_type_changed(d);
}

static void pasted(GObject *clipboard, GAsyncResult *result, gpointer data)
{
    char *text = gdk_clipboard_read_text_finish(GDK_CLIPBOARD(clipboard), result, NULL);
    if (text)
        desk_type_text(data, text);
    g_free(text);
}

bool desk_type_key(struct desk *d, guint key, GdkModifierType state)
{
    const bool control = (state & GDK_CONTROL_MASK) != 0;
    if (key == GDK_KEY_Return || key == GDK_KEY_KP_Enter) {
        if (control)
            desk_type_print(d);
        else
            desk_type_text(d, "\n");
        return true;
    }
    if (key == GDK_KEY_BackSpace) {
        back(d);
        return true;
    }
    if (control && (key == GDK_KEY_v || key == GDK_KEY_V)) {
        gdk_clipboard_read_text_async(gtk_widget_get_clipboard(d->canvas), NULL, pasted, d);
        return true;
    }
    if (key == GDK_KEY_Escape) {
        desk_type_drop(d);
        return true;
    }
    return !control && gdk_keyval_to_unicode(key) != 0; /* never the key of a tool */
}

/* Before all others: what an input method takes, nobody else gets. */
static gboolean filter(GtkEventControllerKey *controller, guint key, guint code,
                       GdkModifierType state, struct desk *d)
{
    (void)code;
    if (!d->typing || gtk_window_get_focus(GTK_WINDOW(d->window)) != d->canvas)
        return FALSE;
    return gtk_im_context_filter_keypress(
               d->input_method,
               gtk_event_controller_get_current_event(GTK_EVENT_CONTROLLER(controller))) ||
           desk_type_key(d, key, state);
}

void desk_type_attach(struct desk *d)
{
    GtkEventController *keys = gtk_event_controller_key_new();
    d->input_method = gtk_im_multicontext_new();
    gtk_im_context_set_client_widget(d->input_method, d->canvas);
    g_signal_connect(d->input_method, "commit", G_CALLBACK(commit), d);
    g_signal_connect(d->input_method, "preedit-changed", G_CALLBACK(preedit), d);
    g_signal_connect(keys, "key-pressed", G_CALLBACK(filter), d);
    gtk_widget_add_controller(d->canvas, keys);
}

/* ---- fonts ---- */

static int order(const void *a, const void *b)
{
    return g_utf8_collate(*(char *const *)a, *(char *const *)b);
}

static void font_chosen(GtkDropDown *choice, GParamSpec *spec, struct desk *d)
{
    GtkStringObject *chosen = gtk_drop_down_get_selected_item(choice);
    (void)spec;
    if (!chosen)
        return;
    g_free(d->font);
    d->font = g_strdup(gtk_string_object_get_string(chosen));
    desk_type_changed(d);
}

static void features_typed(GtkEditable *entry, struct desk *d)
{
    g_free(d->features);
    d->features = g_strdup(gtk_editable_get_text(entry));
    desk_type_changed(d);
}

/* Families as the desktop lists them, and the one that is chosen at first. */
static GtkWidget *fonts_new(struct desk *d)
{
    static const char *const liked[] = {"EB Garamond", "DejaVu Serif", "DejaVu Sans"};
    PangoFontFamily **families;
    int count = 0;
    guint first = 0;
    pango_context_list_families(gtk_widget_get_pango_context(d->window), &families, &count);
    char **names = g_new0(char *, (gsize)count + 1);
    for (int i = 0; i < count; i++)
        names[i] = g_strdup(pango_font_family_get_name(families[i]));
    qsort(names, (size_t)count, sizeof *names, order);
    for (size_t k = G_N_ELEMENTS(liked); k-- > 0;)
        for (int i = 0; i < count; i++)
            if (strcmp(names[i], liked[k]) == 0)
                first = (guint)i;
    GtkWidget *choice = gtk_drop_down_new_from_strings((const char *const *)names);
    GtkExpression *name = gtk_property_expression_new(GTK_TYPE_STRING_OBJECT, NULL, "string");
    gtk_drop_down_set_expression(GTK_DROP_DOWN(choice), name);
    gtk_expression_unref(name);
    gtk_drop_down_set_enable_search(GTK_DROP_DOWN(choice), TRUE);
    gtk_drop_down_set_selected(GTK_DROP_DOWN(choice), first);
    d->font = g_strdup(count > 0 ? names[first] : "DejaVu Sans");
    g_signal_connect(choice, "notify::selected", G_CALLBACK(font_chosen), d);
    g_strfreev(names);
    g_free(families);
    return choice;
}

static void print_clicked(GtkButton *button, struct desk *d)
{
    (void)button;
    desk_type_print(d);
    gtk_widget_grab_focus(d->canvas);
}

GtkWidget *desk_type_new(struct desk *d)
{
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 4), *fonts = fonts_new(d),
              *features = gtk_entry_new(),
              *print = gtk_button_new_with_label(_("Let into the paper"));
    d->typed = g_string_new("");
    desk_name(fonts, _("Font"), _("Font"));
    gtk_entry_set_placeholder_text(GTK_ENTRY(features), _("OpenType features: smcp,-liga"));
    desk_name(features, _("OpenType features"),
              _("OpenType features, separated by commas: smcp,-liga"));
    gtk_widget_set_tooltip_text(print, _("What is typed becomes ink (Ctrl+Enter)"));
    g_signal_connect(features, "changed", G_CALLBACK(features_typed), d);
    g_signal_connect(print, "clicked", G_CALLBACK(print_clicked), d);
    gtk_box_append(GTK_BOX(box), fonts);
    gtk_box_append(GTK_BOX(box), features);
    gtk_box_append(GTK_BOX(box), print);
    return box;
}
