/* desk_pen.c - a pen's pressure and tilt on X11, where GTK tells them only of pens whose driver
 * names their tool.
 *
 * Each report of XInput 2 passes by before GTK joins it with others. They are kept for a
 * moment, with their times, and found again by them. A pen is what has an axis "Abs Pressure".
 * GTK does not tell a pen from a mouse that moves the same pointer, so a mouse's reports are
 * kept, too. Elsewhere (Wayland) pens have tools, and nothing of this is needed.
 */
#include "desk_shared.h"

#ifdef LUTETIA_DESK_X11

#include <X11/extensions/XInput2.h>
#include <gdk/x11/gdkx.h>
#include <math.h>
#include <string.h>

G_GNUC_BEGIN_IGNORE_DEPRECATIONS

enum { REPORTS = 1024, DEVICES = 64, AXES = 3 };
#define NEAR_PX 0.02 /* of one place told twice */
#define FORGOTTEN_MS                                                                           \
    400 /* a press has its own time, but the pressure of the report before it */

struct report {
    guint32 time_ms;
    double x_px, y_px; /* of the surface, pixels of the screen */
    bool moved;        /* else a button was pressed or let go */
    bool pen, eraser;
    double axis[AXES]; /* pressure 0..1, tilts -1..1 */
};

struct device {
    int id;
    bool pen, eraser;
    int number[AXES]; /* of the valuator; -1: it has none */
    double least[AXES], most[AXES], last[AXES];
};

struct desk_pen {
    GdkDisplay *display;
    gulong signal;
    struct device devices[DEVICES];
    int devices_count;
    struct report reports[REPORTS];
    guint reports_count;
};

static void axis_look(Display *x, struct device *device, const XIValuatorClassInfo *v)
{
    static const char *const names[AXES] = {"Abs Pressure", "Abs Tilt X", "Abs Tilt Y"};
    char *label = v->label ? XGetAtomName(x, v->label) : NULL;
    for (int i = 0; i < AXES && label; i++)
        if (strcmp(label, names[i]) == 0 && v->max > v->min) {
            device->number[i] = v->number;
            device->least[i] = v->min;
            device->most[i] = v->max;
        }
    if (label)
        XFree(label);
}

static bool device_is_eraser(const char *name)
{
    char *lower = g_ascii_strdown(name ? name : "", -1);
    const bool is = strstr(lower, "eraser") != NULL;
    g_free(lower);
    return is;
}

static struct device *device_of(struct desk_pen *pen, Display *x, int id)
{
    for (int i = 0; i < pen->devices_count; i++)
        if (pen->devices[i].id == id)
            return &pen->devices[i];
    if (pen->devices_count == DEVICES)
        return NULL;
    struct device *device = &pen->devices[pen->devices_count++];
    int count = 0;
    *device = (struct device){.id = id, .number = {-1, -1, -1}};
    XIDeviceInfo *info = XIQueryDevice(x, id, &count);
    for (int i = 0; info && count > 0 && i < info->num_classes; i++)
        if (info->classes[i]->type == XIValuatorClass)
            axis_look(x, device, (const XIValuatorClassInfo *)(const void *)info->classes[i]);
    if (info && count > 0) /* drivers make the other end a device of that name */
        device->eraser = device_is_eraser(info->name);
    if (info)
        XIFreeDeviceInfo(info);
    device->pen = device->number[0] >= 0;
    return device;
}

static void report_keep(struct desk_pen *pen, struct device *device, const XIDeviceEvent *e)
{
    const double *value = e->valuators.values;
    for (int i = 0; i < 8 * e->valuators.mask_len; i++) {
        if (!XIMaskIsSet(e->valuators.mask, i))
            continue;
        for (int axis = 0; axis < AXES; axis++)
            if (device->number[axis] == i) {
                const double part =
                    (*value - device->least[axis]) / (device->most[axis] - device->least[axis]);
                device->last[axis] = axis ? 2 * part - 1 : part;
            }
        value++;
    }
    struct report *report = &pen->reports[pen->reports_count++ % REPORTS];
    *report = (struct report){.time_ms = (guint32)e->time,
                              .x_px = e->event_x,
                              .y_px = e->event_y,
                              .moved = e->evtype == XI_Motion,
                              .pen = device->pen,
                              .eraser = device->eraser};
    memcpy(report->axis, device->last, sizeof report->axis);
}

static gboolean xevent(GdkX11Display *display, const XEvent *event, struct desk_pen *pen)
{
    (void)display;
    const XGenericEventCookie *cookie = &event->xcookie;
    if (event->type != GenericEvent || !cookie->data ||
        (cookie->evtype != XI_Motion && cookie->evtype != XI_ButtonPress &&
         cookie->evtype != XI_ButtonRelease))
        return FALSE;
    const XIDeviceEvent *e = cookie->data;
    struct device *device = device_of(pen, e->display, e->sourceid);
    if (device)
        report_keep(pen, device, e);
    return FALSE;
}

struct desk_pen *desk_pen_create(GtkWidget *canvas)
{
    struct desk_pen *pen = g_new0(struct desk_pen, 1);
    pen->display = gtk_widget_get_display(canvas);
    if (GDK_IS_X11_DISPLAY(pen->display))
        pen->signal = g_signal_connect(pen->display, "xevent", G_CALLBACK(xevent), pen);
    return pen;
}

void desk_pen_destroy(struct desk_pen *pen)
{
    if (pen && pen->signal)
        g_signal_handler_disconnect(pen->display, pen->signal);
    g_free(pen);
}

static const struct report *newest(const struct desk_pen *pen, guint i)
{
    return &pen->reports[(pen->reports_count - 1 - i) % REPORTS];
}

static bool is_near(const struct report *report, double x_px, double y_px)
{
    return fabs(report->x_px - x_px) <= NEAR_PX && fabs(report->y_px - y_px) <= NEAR_PX;
}

/* A pen's report at r's time, as near as there is one; of several at that time the one from
 * this place of the surface, in pixels of the screen. False: no pen has spoken. */
static bool report_at(const struct desk_pen *pen, double x_px, double y_px,
                      struct desk_report *r)
{
    const guint kept = MIN(pen->reports_count, REPORTS);
    const struct report *nearest = NULL;
    for (guint i = 0; i < kept; i++) {
        const struct report *at = newest(pen, i);
        if (!at->pen || (gint32)(r->time_ms - at->time_ms) < 0)
            continue;
        if (nearest && at->time_ms != r->time_ms)
            break;
        if (!nearest || is_near(at, x_px, y_px))
            nearest = at;
    }
    if (!nearest || r->time_ms - nearest->time_ms > FORGOTTEN_MS)
        return false;
    r->pressure = nearest->axis[0];
    r->tilt[0] = nearest->axis[1];
    r->tilt[1] = nearest->axis[2];
    r->eraser = nearest->eraser;
    return true;
}

/* Whether what came at that time from that place, a move or else a button's, was told by a
 * device that is no pen. */
static bool is_other(const struct desk_pen *pen, guint32 time_ms, double x_px, double y_px,
                     bool moved)
{
    const guint kept = MIN(pen->reports_count, REPORTS);
    bool other = false;
    for (guint i = 0; i < kept; i++) {
        const struct report *r = newest(pen, i);
        if (r->time_ms != time_ms || r->moved != moved || !is_near(r, x_px, y_px))
            continue;
        if (r->pen)
            return false;
        other = true;
    }
    return other;
}

G_GNUC_END_IGNORE_DEPRECATIONS

#else

struct desk_pen *desk_pen_create(GtkWidget *canvas)
{
    (void)canvas;
    return NULL;
}

void desk_pen_destroy(struct desk_pen *pen)
{
    (void)pen;
}

static bool report_at(const struct desk_pen *pen, double x_px, double y_px,
                      struct desk_report *r)
{
    (void)pen;
    (void)x_px;
    (void)y_px;
    (void)r;
    return false;
}

static bool is_other(const struct desk_pen *pen, guint32 time_ms, double x_px, double y_px,
                     bool moved)
{
    (void)pen;
    (void)time_ms;
    (void)x_px;
    (void)y_px;
    (void)moved;
    return false;
}

#endif

/* ---- what GTK tells ---- */

/* Of a surface's place the widget's. */
static bool place_of(GtkWidget *widget, double x, double y, struct desk_report *r)
{
    GtkNative *native = gtk_widget_get_native(widget);
    double left, top;
    graphene_point_t to;
    if (!native)
        return false;
    gtk_native_get_surface_transform(native, &left, &top);
    const graphene_point_t from = {(float)(x - left), (float)(y - top)};
    if (!gtk_widget_compute_point(GTK_WIDGET(native), widget, &from, &to))
        return false;
    r->x = (double)to.x;
    r->y = (double)to.y;
    return true;
}

/* A pen whose tool GTK knows. */
static void tool_report(GdkDeviceTool *tool, GdkEvent *event, const GdkTimeCoord *past,
                        struct desk_report *r)
{
    static const GdkAxisUse uses[] = {GDK_AXIS_PRESSURE, GDK_AXIS_XTILT, GDK_AXIS_YTILT};
    double *const axes[] = {&r->pressure, &r->tilt[0], &r->tilt[1]};
    r->pen = true;
    r->eraser = gdk_device_tool_get_tool_type(tool) == GDK_DEVICE_TOOL_TYPE_ERASER;
    for (size_t i = 0; i < G_N_ELEMENTS(uses); i++)
        if (past)
            *axes[i] = past->axes[uses[i]];
        else
            gdk_event_get_axis(event, uses[i], axes[i]);
}

bool desk_pen_report(struct desk_pen *pen, GtkWidget *widget, GdkEvent *event,
                     const GdkTimeCoord *past, struct desk_report *report)
{
    const double scale = gtk_widget_get_scale_factor(widget);
    const bool moved = gdk_event_get_event_type(event) == GDK_MOTION_NOTIFY;
    GdkDeviceTool *tool = gdk_event_get_device_tool(event);
    double x = 0, y = 0;
    *report = (struct desk_report){.time_ms = past ? past->time : gdk_event_get_time(event)};
    if (past) {
        x = past->axes[GDK_AXIS_X];
        y = past->axes[GDK_AXIS_Y];
    } else
        gdk_event_get_position(event, &x, &y);
    if (!place_of(widget, x, y, report))
        return false;
    if (tool && (gdk_device_tool_get_axes(tool) & GDK_AXIS_FLAG_PRESSURE)) {
        tool_report(tool, event, past, report);
        return true;
    }
    struct desk_report felt = *report;
    if (report_at(pen, scale * x, scale * y, &felt) &&
        !is_other(pen, felt.time_ms, scale * x, scale * y, moved)) {
        *report = felt;
        report->pen = true;
    }
    return true;
}
