/* window_x11.c - see window_x11.h. The X libraries are loaded where they are needed. */
#include "window_x11.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/extensions/XShm.h>
#include <endian.h>
#include <fcntl.h>
#include <library.h>
#include <math.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ipc.h>
#include <sys/shm.h>
#include <time.h>
#include <unistd.h>

/* clang-format off */
#define X_NAMES(X)                                                                             \
    X(OpenDisplay) X(CloseDisplay) X(GetWindowAttributes) X(CreateGC) X(FreeGC) X(Sync)        \
    X(SetErrorHandler) X(ShmQueryExtension) X(ShmCreateImage) X(ShmAttach) X(ShmDetach)        \
    X(ShmPutImage) X(ShmGetEventBase) X(CheckTypedEvent) X(Flush) X(Pending)                  \
    X(SetIOErrorHandler)
/* clang-format on */

#define X_MEMBER(name) __typeof__(X##name) *name;
static struct x {
    X_NAMES(X_MEMBER)
} x;

/* libXext comes with libX11, whose functions are found through it. */
static bool library_loaded(void)
{
#define X_ROW(name) {"X" #name, offsetof(struct x, name)},
    static const struct library_function functions[] = {X_NAMES(X_ROW)};
    const char *missing;
    return x.OpenDisplay || library_load("libXext.so.6", functions,
                                         sizeof functions / sizeof *functions, &x, &missing);
}

struct window_x11 {
    Display *display;
    Window window;
    XWindowAttributes attributes;
    GC context;
    XImage *image; /* NULL: there is none yet */
    XShmSegmentInfo segment;
    int put_event; /* of a picture that the server has read */
    bool putting;  /* it may be reading one */
    /* Memory of another's, and the picture there that is seen; seen is that or image. */
    bool share_tried;
    XShmSegmentInfo shared; /* shmseg 0: there is none */
    XImage *shared_image, *seen;
};

static bool refused;

static int error_note(Display *display, XErrorEvent *event)
{
    (void)display, (void)event;
    refused = true;
    return 0;
}

static bool pixels_are_known(const XWindowAttributes *a)
{
    const Visual *v = a->visual;
    return v && (a->depth == 24 || a->depth == 32) && v->red_mask == 0xff0000 &&
           v->green_mask == 0xff00 && v->blue_mask == 0xff;
}

/* The server has read the picture when this returns, so the next one may be kept. A program's
 * pictures are 1/60 s apart, and it has said so long before. */
static void put_end(struct window_x11 *x11)
{
    XEvent event;
    if (x11->putting && !x.CheckTypedEvent(x11->display, x11->put_event, &event)) {
        x.Sync(x11->display, False);
        x.CheckTypedEvent(x11->display, x11->put_event, &event);
    }
    x11->putting = false;
}

static void image_end(struct window_x11 *x11)
{
    if (!x11->image)
        return;
    put_end(x11);
    x.ShmDetach(x11->display, &x11->segment);
    x.Sync(x11->display, False);
    XDestroyImage(x11->image);
    shmdt(x11->segment.shmaddr);
    x11->seen = x11->seen == x11->image ? NULL : x11->seen;
    x11->image = NULL;
}

static void shared_image_end(struct window_x11 *x11)
{
    if (!x11->shared_image)
        return;
    put_end(x11);
    x11->shared_image->data = NULL;
    XDestroyImage(x11->shared_image);
    x11->seen = x11->seen == x11->shared_image ? NULL : x11->seen;
    x11->shared_image = NULL;
}

/* A server on another computer, or in another container, has the extension and refuses here. */
static bool image_begin(struct window_x11 *x11, int width_px, int height_px)
{
    XImage *image = x.ShmCreateImage(
        x11->display, x11->attributes.visual, (unsigned int)x11->attributes.depth, ZPixmap,
        NULL, &x11->segment, (unsigned int)width_px, (unsigned int)height_px);
    if (!image)
        return false;
    const size_t bytes = (size_t)image->bytes_per_line * (size_t)height_px;
    x11->segment.shmid = image->bits_per_pixel == 32 && image->byte_order == LSBFirst
                             ? shmget(IPC_PRIVATE, bytes, IPC_CREAT | 0600)
                             : -1;
    void *at = x11->segment.shmid >= 0 ? shmat(x11->segment.shmid, NULL, 0) : (void *)-1;
    refused = at == (void *)-1;
    if (!refused) {
        x11->segment.shmaddr = image->data = at;
        x11->segment.readOnly = True;
        int (*before)(Display *, XErrorEvent *) = x.SetErrorHandler(error_note);
        x.ShmAttach(x11->display, &x11->segment);
        x.Sync(x11->display, False);
        x.SetErrorHandler(before);
    }
    if (x11->segment.shmid >= 0)
        shmctl(x11->segment.shmid, IPC_RMID, NULL); /* it goes with the last who has it */
    if (!refused) {
        x11->image = image;
        return true;
    }
    if (at != (void *)-1)
        shmdt(at);
    image->data = NULL;
    XDestroyImage(image);
    return false;
}

struct window_x11 *window_x11_begin(unsigned long window)
{
    struct window_x11 *x11 = library_loaded() ? calloc(1, sizeof *x11) : NULL;
    if (!x11)
        return NULL;
    x11->window = window;
    x11->display = x.OpenDisplay(NULL);
    if (x11->display && x.ShmQueryExtension(x11->display) &&
        x.GetWindowAttributes(x11->display, window, &x11->attributes) &&
        pixels_are_known(&x11->attributes) &&
        (x11->context = x.CreateGC(x11->display, window, 0, NULL)) && image_begin(x11, 1, 1)) {
        x11->put_event = x.ShmGetEventBase(x11->display) + ShmCompletion;
        return x11;
    }
    window_x11_end(x11);
    return NULL;
}

void window_x11_end(struct window_x11 *x11)
{
    if (!x11)
        return;
    image_end(x11);
    shared_image_end(x11);
    if (x11->context)
        x.FreeGC(x11->display, x11->context);
    if (x11->display)
        x.CloseDisplay(x11->display);
    free(x11);
}

bool window_x11_room(struct window_x11 *x11, int width_px, int height_px,
                     struct display_room *room)
{
    const XImage *kept = x11->image;
    if (!kept || kept->width != width_px || kept->height != height_px) {
        image_end(x11);
        if (!image_begin(x11, width_px, height_px))
            return false;
    }
    put_end(x11);
    room->pixels = (void *)x11->image->data;
    room->stride = (size_t)x11->image->bytes_per_line / sizeof *room->pixels;
    return true;
}

static void image_put(struct window_x11 *x11, XImage *image)
{
    put_end(x11);
    x.ShmPutImage(x11->display, x11->window, x11->context, image, 0, 0, 0, 0,
                  (unsigned int)image->width, (unsigned int)image->height, True);
    x.Flush(x11->display);
    x11->putting = true;
    x11->seen = image;
}

void window_x11_put(struct window_x11 *x11)
{
    image_put(x11, x11->image);
}

void window_x11_put_again(struct window_x11 *x11)
{
    if (x11->seen)
        image_put(x11, x11->seen);
}

void window_x11_settle(struct window_x11 *x11)
{
    put_end(x11);
}

const uint8_t *window_x11_pixels(const struct window_x11 *x11, int *width_px, int *height_px)
{
    *width_px = x11->seen ? x11->seen->width : 0;
    *height_px = x11->seen ? x11->seen->height : 0;
    return x11->seen ? (const uint8_t *)x11->seen->data : NULL;
}

/* ---- memory of another's ---- */

/* Xlib cannot hand a file's memory to the server; the library below it can. */
struct cookie {
    unsigned int sequence;
};
static struct {
    void *(*XGetXCBConnection)(Display *display);
    uint32_t (*xcb_generate_id)(void *connection);
    void *(*xcb_request_check)(void *connection, struct cookie cookie);
    struct cookie (*xcb_shm_attach_fd_checked)(void *connection, uint32_t segment,
                                               int32_t descriptor, uint8_t read_only);
} xcb;

static bool xcb_loaded(void)
{
    static const struct library_function between[] = {LIBRARY_FUNCTION(xcb, XGetXCBConnection)},
                                         base[] = {LIBRARY_FUNCTION(xcb, xcb_generate_id),
                                                   LIBRARY_FUNCTION(xcb, xcb_request_check)},
                                         memory[] = {
                                             LIBRARY_FUNCTION(xcb, xcb_shm_attach_fd_checked)};
    const char *missing;
    return xcb.xcb_shm_attach_fd_checked ||
           (library_load_exactly("libX11-xcb.so.1", between, 1, &xcb, &missing) &&
            library_load_exactly("libxcb.so.1", base, 2, &xcb, &missing) &&
            library_load_exactly("libxcb-shm.so.0", memory, 1, &xcb, &missing));
}

bool window_x11_share(struct window_x11 *x11, int descriptor, const void *at)
{
    if (x11->share_tried)
        return x11->shared.shmseg != 0;
    x11->share_tried = true;
    const int own = fcntl(descriptor, F_DUPFD_CLOEXEC, 3); /* which the library closes */
    if (own < 0 || x11->attributes.depth != 24 || !xcb_loaded()) {
        if (own >= 0)
            close(own);
        return false;
    }
    void *connection = xcb.XGetXCBConnection(x11->display);
    const uint32_t segment = xcb.xcb_generate_id(connection);
    void *error = xcb.xcb_request_check(
        connection, xcb.xcb_shm_attach_fd_checked(connection, segment, own, 1));
    if (!error)
        x11->shared = (XShmSegmentInfo){.shmseg = segment, .shmaddr = (char *)(uintptr_t)at};
    free(error);
    return !error;
}

bool window_x11_put_shared(struct window_x11 *x11, const uint8_t *pixels, int width_px,
                           int height_px)
{
    XImage *image = x11->shared_image;
    if (!x11->shared.shmseg)
        return false;
    if (image && (image->width != width_px || image->height != height_px)) {
        shared_image_end(x11);
        image = NULL;
    }
    if (!image)
        image = x11->shared_image =
            x.ShmCreateImage(x11->display, x11->attributes.visual, 24, ZPixmap, NULL,
                             &x11->shared, (unsigned int)width_px, (unsigned int)height_px);
    if (!image || image->bits_per_pixel != 32 || image->byte_order != LSBFirst ||
        image->bytes_per_line != 4 * width_px)
        return false;
    put_end(x11);
    image->data = (char *)(uintptr_t)pixels;
    image_put(x11, image);
    return true;
}

static struct {
    void (*call)(void *context);
    void *context;
} lost;

/* Whoever saves may meet the lost connection again. */
static int lost_take(Display *display)
{
    void (*const call)(void *) = lost.call;
    (void)display;
    lost.call = NULL;
    if (call)
        call(lost.context);
    return 0;
}

void window_x11_lost_set(void (*call)(void *context), void *context)
{
    lost.call = call;
    lost.context = context;
    if (library_loaded())
        x.SetIOErrorHandler(call ? lost_take : NULL);
}

bool window_x11_waits(void)
{
    return library_loaded();
}

void window_x11_wait(void *display, int descriptor, double wait_s)
{
    struct pollfd either[] = {{.fd = ConnectionNumber(display), .events = POLLIN},
                              {.fd = descriptor, .events = POLLIN}};
    const double s = fmin(wait_s, 1e6);
    const struct timespec wait = {(time_t)s, (long)(1e9 * (s - floor(s)))};
    if (!x.Pending(display)) /* what was read is in its queue */
        ppoll(either, 2, &wait, NULL);
}
