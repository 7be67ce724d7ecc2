/* pen_x11.c - reports of X11's input devices, by XInput 2: see pen.h. libX11 and libXi are
 * loaded when a window is opened: most programs have none. */
#include "pen.h"

#include <X11/Xlib.h>
#include <X11/extensions/XInput2.h>
#include <library.h>
#include <stdlib.h>
#include <string.h>

enum { DEVICES_MAX = 64 };

/* clang-format off */
#define X_NAMES(X)                                                                             \
    X(OpenDisplay) X(CloseDisplay) X(QueryExtension) X(InternAtom) X(Flush)                    \
    X(Pending) X(NextEvent) X(GetEventData) X(FreeEventData)
#define XI_NAMES(X) X(QueryVersion) X(QueryDevice) X(FreeDeviceInfo) X(SelectEvents)
/* clang-format on */

#define X_MEMBER(name) __typeof__(X##name) *name;
#define XI_MEMBER(name) __typeof__(XI##name) *name;
static struct x {
    X_NAMES(X_MEMBER)
} x;
static struct xi {
    XI_NAMES(XI_MEMBER)
} xi;

static bool libraries_load(void)
{
#define X_ROW(name) {"X" #name, offsetof(struct x, name)},
#define XI_ROW(name) {"XI" #name, offsetof(struct xi, name)},
    static const struct library_function x_functions[] = {X_NAMES(X_ROW)},
                                         xi_functions[] = {XI_NAMES(XI_ROW)};
    const char *missing;
    return (x.OpenDisplay ||
            library_load("libX11.so.6", x_functions, sizeof x_functions / sizeof *x_functions,
                         &x, &missing)) &&
           (xi.QueryVersion ||
            library_load("libXi.so.6", xi_functions, sizeof xi_functions / sizeof *xi_functions,
                         &xi, &missing));
}

struct pen {
    Display *display;
    int opcode; /* the first event code of the extension */
    Atom pressure, tilt_x, tilt_y;
    struct {
        int id;
        struct pen_axes axes;
    } devices[DEVICES_MAX]; /* devices that measure pressure */
    int devices_count;
    struct pen_state state;
};

static struct pen_axes axes_of(const struct pen *pen, const XIDeviceInfo *device)
{
    struct pen_axes axes = {{-1, 0, 0}, {-1, 0, 0}, {-1, 0, 0}};
    for (int i = 0; i < device->num_classes; i++) {
        if (device->classes[i]->type != XIValuatorClass)
            continue;
        XIValuatorClassInfo v;
        memcpy(&v, device->classes[i], sizeof v);
        struct pen_axis axis = {v.number, v.min, v.max};
        if (v.label == pen->pressure)
            axes.pressure = axis;
        else if (v.label == pen->tilt_x)
            axes.tilt_x = axis;
        else if (v.label == pen->tilt_y)
            axes.tilt_y = axis;
    }
    return axes;
}

static void devices_find(struct pen *pen)
{
    int count = 0;
    XIDeviceInfo *all = xi.QueryDevice(pen->display, XIAllDevices, &count);
    pen->devices_count = 0;
    for (int i = 0; all && i < count && pen->devices_count < DEVICES_MAX; i++) {
        struct pen_axes axes = axes_of(pen, &all[i]);
        if (all[i].use != XISlavePointer || axes.pressure.number < 0)
            continue;
        pen->devices[pen->devices_count].id = all[i].deviceid;
        pen->devices[pen->devices_count++].axes = axes;
    }
    if (all)
        xi.FreeDeviceInfo(all);
}

static void events_select(struct pen *pen)
{
    unsigned char raw[XIMaskLen(XI_LASTEVENT)] = {0}, changes[XIMaskLen(XI_LASTEVENT)] = {0};
    XISetMask(raw, XI_RawMotion);
    XISetMask(raw, XI_RawButtonPress);
    XISetMask(raw, XI_RawButtonRelease);
    XISetMask(changes, XI_HierarchyChanged);
    XIEventMask masks[2] = {{XIAllMasterDevices, sizeof raw, raw},
                            {XIAllDevices, sizeof changes, changes}};
    xi.SelectEvents(pen->display, DefaultRootWindow(pen->display), masks, 2);
    x.Flush(pen->display);
}

struct pen *pen_open(void)
{
    int first_event, first_error, major = 2, minor = 1; /* version 2.1 sends raw events
                                                         * during grabs, too */
    struct pen *pen = calloc(1, sizeof *pen);
    if (!pen)
        return NULL;
    pen->display = libraries_load() ? x.OpenDisplay(NULL) : NULL;
    if (!pen->display ||
        !x.QueryExtension(pen->display, "XInputExtension", &pen->opcode, &first_event,
                          &first_error) ||
        xi.QueryVersion(pen->display, &major, &minor) != Success) {
        pen_close(pen);
        return NULL;
    }
    pen->pressure = x.InternAtom(pen->display, "Abs Pressure", False);
    pen->tilt_x = x.InternAtom(pen->display, "Abs Tilt X", False);
    pen->tilt_y = x.InternAtom(pen->display, "Abs Tilt Y", False);
    devices_find(pen);
    events_select(pen);
    return pen;
}

void pen_close(struct pen *pen)
{
    if (!pen)
        return;
    if (pen->display)
        x.CloseDisplay(pen->display);
    free(pen);
}

static void report_take(struct pen *pen, const XIRawEvent *raw)
{
    static const struct pen_axes none = {{-1, 0, 0}, {-1, 0, 0}, {-1, 0, 0}};
    const struct pen_axes *axes = &none;
    for (int i = 0; i < pen->devices_count; i++)
        if (pen->devices[i].id == raw->sourceid)
            axes = &pen->devices[i].axes;
    pen_report(axes, raw->valuators.mask, raw->valuators.mask_len, raw->valuators.values,
               &pen->state);
}

struct pen_state pen_now(struct pen *pen)
{
    if (!pen)
        return (struct pen_state){0};
    while (x.Pending(pen->display)) {
        XEvent event;
        x.NextEvent(pen->display, &event);
        if (event.type != GenericEvent || event.xcookie.extension != pen->opcode ||
            !x.GetEventData(pen->display, &event.xcookie))
            continue;
        if (event.xcookie.evtype == XI_HierarchyChanged)
            devices_find(pen);
        else
            report_take(pen, event.xcookie.data);
        x.FreeEventData(pen->display, &event.xcookie);
    }
    return pen->state;
}
