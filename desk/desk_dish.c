/* desk_dish.c - the dish: eight wells, each with its water and pigments; the swatch of the one
 * that brushes dip into; the sheet's pigments. The board: where the ball lies is where water
 * flows. */
#include "desk.h"

#include "studio_swatch.h"

#include <math.h>
#include <visible_text.h>

/* ---- swatches ---- */

/* Thick on the left, thin on the right, as a stroke that dries out. */
static void swatch_draw(GtkDrawingArea *area, cairo_t *cr, int width, int height, gpointer data)
{
    struct desk *d = data;
    const gpointer well = g_object_get_data(G_OBJECT(area), "well");
    const double *amount = d->well_amount[well ? GPOINTER_TO_INT(well) - 1 : d->well];
    const int bands = well ? 1 : 24;
    for (int i = 0; i < bands; i++) {
        double thinned[1 + PAPER_PIGMENTS_MAX], rgb[3];
        for (int k = 0; k <= PAPER_PIGMENTS_MAX; k++)
            thinned[k] = amount[k] * (well ? 1 : 1.2 * (1 - (double)i / bands));
        studio_swatch(&d->report.config, thinned, rgb);
        cairo_set_source_rgb(cr, rgb[0], rgb[1], rgb[2]);
        cairo_rectangle(cr, (double)width * i / bands, 0, (double)width / bands + 1, height);
        cairo_fill(cr);
    }
}

static void well_chosen(GtkToggleButton *button, struct desk *d)
{
    if (!d->filling && gtk_toggle_button_get_active(button))
        desk_dish_well(d, GPOINTER_TO_INT(g_object_get_data(G_OBJECT(button), "well")) - 1);
}

static GtkWidget *well_new(struct desk *d, int well)
{
    GtkWidget *button = gtk_toggle_button_new(), *area = gtk_drawing_area_new();
    char *name = g_strdup_printf(_("Well %d of the dish"), well + 1);
    char *tip =
        g_strdup_printf(_("Well %d: dip into it, and mix in it. Key: %d"), well + 1, well + 1);
    gtk_drawing_area_set_content_width(GTK_DRAWING_AREA(area), 18);
    gtk_drawing_area_set_content_height(GTK_DRAWING_AREA(area), 20);
    gtk_drawing_area_set_draw_func(GTK_DRAWING_AREA(area), swatch_draw, d, NULL);
    g_object_set_data(G_OBJECT(area), "well", GINT_TO_POINTER(well + 1));
    g_object_set_data(G_OBJECT(button), "well", GINT_TO_POINTER(well + 1));
    gtk_button_set_child(GTK_BUTTON(button), area);
    gtk_widget_set_hexpand(button, TRUE);
    desk_choice(button);
    desk_name(button, name, tip);
    if (well)
        gtk_toggle_button_set_group(GTK_TOGGLE_BUTTON(button), GTK_TOGGLE_BUTTON(d->wells[0]));
    g_signal_connect(button, "toggled", G_CALLBACK(well_chosen), d);
    g_free(name);
    g_free(tip);
    return button;
}

static GtkWidget *palettes_new(void)
{
    static const struct {
        const char *label, *action, *tip;
    } buttons[] = {
        {N_("Open a palette…"), "win.palette-open",
         N_("Fill the wells from a file (Ctrl+Shift+O)")},
        {N_("Save the palette…"), "win.palette-save",
         N_("Write what is in the wells to a file (Ctrl+Shift+P)")},
    };
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 4);
    for (size_t i = 0; i < G_N_ELEMENTS(buttons); i++) {
        GtkWidget *button = gtk_button_new_with_label(_(buttons[i].label));
        gtk_actionable_set_action_name(GTK_ACTIONABLE(button), buttons[i].action);
        gtk_widget_set_hexpand(button, TRUE);
        desk_name(button, _(buttons[i].label), _(buttons[i].tip));
        gtk_box_append(GTK_BOX(box), button);
    }
    return box;
}

GtkWidget *desk_dish_new(struct desk *d)
{
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 2),
              *wells = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 2);
    d->swatch = gtk_drawing_area_new();
    gtk_drawing_area_set_content_height(GTK_DRAWING_AREA(d->swatch), 28);
    gtk_drawing_area_set_draw_func(GTK_DRAWING_AREA(d->swatch), swatch_draw, d, NULL);
    desk_name(d->swatch, _("What is in the dish, on this paper"),
              _("What is in the dish, on this paper when it is "
                "dry: as it is, and ever thinner"));
    for (int i = 0; i < STUDIO_WELLS; i++) {
        d->wells[i] = well_new(d, i);
        gtk_box_append(GTK_BOX(wells), d->wells[i]);
    }
    gtk_box_append(GTK_BOX(box), wells);
    gtk_box_append(GTK_BOX(box), palettes_new());
    gtk_box_append(GTK_BOX(box), d->swatch);
    gtk_box_append(GTK_BOX(box), desk_row_new(d, STUDIO_WATER, NULL));
    d->dish_box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 2);
    gtk_box_append(GTK_BOX(box), d->dish_box);
    return box;
}

/* Another sheet: a row for each of its pigments, and in the wells each pigment alone, then
 * pairs. */
void desk_panel_sheet(struct desk *d)
{
    const struct paper_sheet_config *config = &d->report.config;
    const int count = config->pigments_count;
    GtkWidget *child;
    while ((child = gtk_widget_get_first_child(d->dish_box)))
        gtk_box_remove(GTK_BOX(d->dish_box), child);
    for (int i = 0; i < PAPER_PIGMENTS_MAX; i++)
        d->rows[STUDIO_PIGMENT + i] = NULL;
    for (int i = 0; i < count; i++)
        gtk_box_append(GTK_BOX(d->dish_box),
                       desk_row_new(d, STUDIO_PIGMENT + i, config->pigments[i].name));
    memset(d->well_amount, 0, sizeof d->well_amount);
    for (int well = 0; well < STUDIO_WELLS && count > 0; well++) {
        d->well_amount[well][0] = studio_controls[STUDIO_WATER].usual;
        d->well_amount[well][1 + well % count] = well < count ? 0.6 : 0.4;
        if (well >= count && count > 1)
            d->well_amount[well][1 + (well + 1) % count] = 0.3;
    }
    desk_dish_well(d, 0);
}

void desk_dish_changed(struct desk *d)
{
    studio_settings_amounts(&d->settings, d->well_amount[d->well]);
    gtk_widget_queue_draw(d->swatch);
    gtk_widget_queue_draw(gtk_button_get_child(GTK_BUTTON(d->wells[d->well])));
}

void desk_dish_well(struct desk *d, int well)
{
    double amount[1 + PAPER_PIGMENTS_MAX];
    memcpy(amount, d->well_amount[well], sizeof amount);
    d->well = well;
    for (int i = 0; i <= d->report.config.pigments_count; i++)
        desk_set(d, STUDIO_WATER + i, amount[i]);
    gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(d->wells[well]), TRUE);
    for (int i = 0; i < STUDIO_WELLS; i++)
        gtk_widget_queue_draw(gtk_button_get_child(GTK_BUTTON(d->wells[i])));
}

/* ---- palettes ---- */

void desk_palette_open(struct desk *d, const char *path)
{
    struct studio_palette palette;
    char why[STUDIO_TEXT_MAX + 500];
    if (!studio_palette_read(path, &d->report.config, &palette, why, sizeof why)) {
        desk_say(d, why);
        visible_say("lutetia studio: %s", why);
        return;
    }
    for (int well = 0; well < STUDIO_WELLS; well++)
        if (palette.filled[well])
            memcpy(d->well_amount[well], palette.amount[well], sizeof palette.amount[well]);
    desk_dish_well(d, d->well);
    char *text = palette.missing[0]
                     ? g_strdup_printf(_("This sheet does not have: %s. They are left out."),
                                       palette.missing)
                     : g_strdup_printf(_("In the dish: %s."), path);
    desk_say(d, text);
    g_free(text);
}

void desk_palette_save(struct desk *d, const char *path)
{
    struct studio_palette palette = {0};
    char why[STUDIO_TEXT_MAX + 500];
    memcpy(palette.amount, d->well_amount, sizeof palette.amount);
    const bool written =
        studio_palette_write(path, &d->report.config, &palette, why, sizeof why);
    char *text = written ? g_strdup_printf(_("Written: %s."), path) : g_strdup(why);
    desk_say(d, text);
    if (!written)
        visible_say("lutetia studio: %s", why);
    g_free(text);
}

/* ---- the board ---- */

enum { BOARD = 84 };

static void board_draw(GtkDrawingArea *area, cairo_t *cr, int width, int height, gpointer data)
{
    const struct desk *d = data;
    const double side = MIN(width, height), middle_x = width / 2.0, middle_y = height / 2.0,
                 reach = side / 2 - 9;
    GdkRGBA color;
    GtkStyleContext *style = gtk_widget_get_style_context(GTK_WIDGET(area));
    gtk_style_context_get_color(style, &color);
    cairo_set_line_width(cr, 1);
    cairo_set_source_rgba(cr, (double)color.red, (double)color.green, (double)color.blue, 0.6);
    cairo_arc(cr, middle_x, middle_y, side / 2 - 1, 0, 2 * G_PI);
    cairo_move_to(cr, middle_x - 4, middle_y);
    cairo_line_to(cr, middle_x + 4, middle_y);
    cairo_move_to(cr, middle_x, middle_y - 4);
    cairo_line_to(cr, middle_x, middle_y + 4);
    cairo_stroke(cr);
    gdk_cairo_set_source_rgba(cr, &color);
    cairo_arc(cr, middle_x + reach * d->settings.value[STUDIO_TILT_X],
              middle_y + reach * d->settings.value[STUDIO_TILT_Y], 7, 0, 2 * G_PI);
    cairo_fill(cr);
}

static void board_put(struct desk *d, double x, double y)
{
    const double most = studio_controls[STUDIO_TILT_X].most, reach = BOARD / 2.0 - 9,
                 right = (x - gtk_widget_get_width(d->board) / 2.0) / reach,
                 below = (y - gtk_widget_get_height(d->board) / 2.0) / reach,
                 length = hypot(right, below), part = length > most ? most / length : 1;
    const bool level = length < 0.1; /* the middle is easily hit */
    desk_set(d, STUDIO_TILT_X, level ? 0 : part * right);
    desk_set(d, STUDIO_TILT_Y, level ? 0 : part * below);
    gtk_widget_queue_draw(d->board);
}

static void board_begin(GtkGestureDrag *drag, double x, double y, struct desk *d)
{
    (void)drag;
    board_put(d, x, y);
}

static void board_move(GtkGestureDrag *drag, double by_x, double by_y, struct desk *d)
{
    double x, y;
    if (gtk_gesture_drag_get_start_point(drag, &x, &y))
        board_put(d, x + by_x, y + by_y);
}

GtkWidget *desk_board_new(struct desk *d)
{
    GtkGesture *drag = gtk_gesture_drag_new();
    d->board = gtk_drawing_area_new();
    gtk_drawing_area_set_content_width(GTK_DRAWING_AREA(d->board), BOARD);
    gtk_drawing_area_set_content_height(GTK_DRAWING_AREA(d->board), BOARD);
    gtk_drawing_area_set_draw_func(GTK_DRAWING_AREA(d->board), board_draw, d, NULL);
    gtk_widget_set_halign(d->board, GTK_ALIGN_CENTER);
    desk_name(d->board, _("The board's tilt; tilt x and tilt y say it in numbers"),
              _("Drag the ball: water flows where it lies. In the middle the "
                "board is level."));
    g_signal_connect(drag, "drag-begin", G_CALLBACK(board_begin), d);
    g_signal_connect(drag, "drag-update", G_CALLBACK(board_move), d);
    gtk_widget_add_controller(d->board, GTK_EVENT_CONTROLLER(drag));
    return d->board;
}
