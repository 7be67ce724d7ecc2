/* desk_common.c - what all files of the window use: telling people, telling the paper, what the
 * tool leaves. */
#include "desk.h"

#include "studio_swatch.h"

void desk_say(struct desk *d, const char *text)
{
    gtk_label_set_text(GTK_LABEL(d->notice_text), text);
    gtk_revealer_set_reveal_child(GTK_REVEALER(d->notice), TRUE);
}

void desk_choice(GtkWidget *button)
{
    static const char style[] =
        ".desk-choice:checked { box-shadow: inset 0 0 0 1px alpha(currentColor, 0.6); }";
    static GtkCssProvider *provider;
    if (!provider) {
        provider = gtk_css_provider_new();
        gtk_css_provider_load_from_data(provider, style, -1);
        gtk_style_context_add_provider_for_display(gtk_widget_get_display(button),
                                                   GTK_STYLE_PROVIDER(provider),
                                                   GTK_STYLE_PROVIDER_PRIORITY_APPLICATION);
    }
    gtk_widget_add_css_class(button, "desk-choice");
}

/* ---- to the paper ---- */

void desk_send(struct desk *d, enum studio_message_kind kind)
{
    desk_measure_sent(d, studio_paper_send(d->paper, (struct studio_message){.kind = kind}));
}

void desk_set(struct desk *d, int setting, double value)
{
    const int kind = (int)d->settings.value[STUDIO_BRUSH];
    if (stage_control_write(&studio_controls[setting], &d->settings, value) != STAGE_OK) {
        desk_say(d, stage_error());
        return;
    }
    if (setting == STUDIO_BRUSH && (int)value != kind)
        studio_settings_kind(&d->settings, (int)value);
    for (int i = 0; i < STUDIO_SETTINGS; i++)
        if (i == setting || (setting == STUDIO_BRUSH && i > STUDIO_BRUSH && i < STUDIO_REFILL))
            studio_paper_send(d->paper, (struct studio_message){.kind = STUDIO_MESSAGE_SET,
                                                                .setting = i,
                                                                .value = d->settings.value[i]});
    d->changed(d, setting);
}

/* ---- the tool ---- */

enum studio_tool_number desk_tool(const struct desk *d)
{
    return d->eraser ? studio_settings_eraser(&d->settings)
                     : (enum studio_tool_number)d->settings.value[STUDIO_TOOL];
}

double desk_cursor_radius(const struct desk *d)
{
    const double *value = d->settings.value;
    switch (desk_tool(d)) {
    case STUDIO_TOOL_BRUSH:
    case STUDIO_TOOL_WATER:
        return studio_tuft_radius(value[STUDIO_WIDTH], value[STUDIO_POINT], value[STUDIO_SPLAY],
                                  d->pressure);
    case STUDIO_TOOL_BLOT:
    case STUDIO_TOOL_LIFT:
    case STUDIO_TOOL_MASK:
    case STUDIO_TOOL_UNMASK:
    case STUDIO_TOOL_VARNISH:
        return value[STUDIO_WIDTH] / 2;
    case STUDIO_TOOL_DROP:
        return value[STUDIO_SIZE];
    case STUDIO_TOOL_SPLATTER:
    case STUDIO_TOOL_SALT:
        return value[STUDIO_SCATTER];
    case STUDIO_TOOL_WASH:
    case STUDIO_TOOL_TYPE:
    case STUDIO_TOOL_SELECT:
    case STUDIO_TOOL_STAMP:
    case STUDIO_TOOLS:
        break;
    }
    return 0;
}

void desk_tool_color(const struct desk *d, double rgb[3])
{
    double amount[1 + PAPER_PIGMENTS_MAX];
    studio_settings_amounts(&d->settings, amount);
    studio_swatch(&d->report.config, amount, rgb);
    if (!studio_tools[desk_tool(d)].inked)
        rgb[0] = rgb[1] = rgb[2] = 0.7;
}
