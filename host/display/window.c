/* window.c - windows by GLFW; the image is a texture on one rectangle.
 *
 * The rectangle fills a viewport that has the image's ratio and lies on whole pixels, so there
 * are no matrices, and an image of the viewport's size is copied texel by texel.  OpenGL 2.1
 * without shaders is enough for that, and every driver has it.  Its functions are asked of GLFW
 * at run time: the program is not linked with libGL and starts where there is none.
 *
 * GLFW is never terminated: terminating it with each last window would unload the driver,
 * and leak the resources that drivers keep to the end of the process.
 */
#include "display_internal.h"
#include "screens.h"
#include "window_internal.h"
#include "window_repeat.h"

#include <endian.h>
#include <math.h>
#include <poll.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <unistd.h>

struct window_config window_config_default(void)
{
    return (struct window_config){
        .title = "lutetia", .width_px = 960, .height_px = 960, .vsync = true};
}

bool window_possible(void)
{
    const char *x = getenv("DISPLAY"), *wayland = getenv("WAYLAND_DISPLAY");
    return (x && *x) || (wayland && *wayland);
}

/* ---- drawing ---- */

static void rectangle_draw(const struct gl *gl)
{
    static const float corners[4][2] = {
        {0, 1}, {1, 1}, {1, 0}, {0, 0}}; /* texture coordinates */
    gl->Begin(GL_QUADS);
    for (int i = 0; i < 4; i++) {
        gl->TexCoord2f(corners[i][0], corners[i][1]);
        gl->Vertex2f(2 * corners[i][0] - 1, 1 - 2 * corners[i][1]);
    }
    gl->End();
}

/* Nearest texel for an image of the viewport's size, bilinear otherwise; mipmaps for a
 * shrunk image. */
static void filter_choose(struct window *window, double scale)
{
    const struct gl *gl = &window->gl;
    bool means = scale < 1 && gl->GenerateMipmap;
    if (means && !window->mipmaps) {
        gl->GenerateMipmap(GL_TEXTURE_2D);
        window->mipmaps = true;
    }
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER,
                      means        ? GL_LINEAR_MIPMAP_LINEAR
                      : scale == 1 ? GL_NEAREST
                                   : GL_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER,
                      scale == 1 ? GL_NEAREST : GL_LINEAR);
}

/* The window has got another size than its picture, which is scaled from now on. */
static void texture_from_direct(struct window *window)
{
    const struct gl *gl = &window->gl;
    int width, height;
    const uint8_t *pixels = window_x11_pixels(window->x11, &width, &height);
    gl->BindTexture(GL_TEXTURE_2D, window->texture);
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl->TexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, width, height, 0, GL_BGRA, GL_UNSIGNED_BYTE,
                   pixels);
    window->direct = window->mipmaps = false;
    window->channels = gl->GetError() == GL_NO_ERROR ? 3 : 0;
}

/* Four bytes are read for a pixel of three, which is faster; but not of the last one. */
static void row_keep(const uint8_t *from, uint32_t *to, int count)
{
    uint32_t four;
    for (int i = 0; i < count - 1; i++, from += 3) {
        memcpy(&four, from, sizeof four);
        to[i] = UINT32_C(0xff000000) | be32toh(four) >> 8;
    }
    to[count - 1] =
        UINT32_C(0xff000000) | (uint32_t)from[0] << 16 | (uint32_t)from[1] << 8 | from[2];
}

bool window_room_begin(struct window *window, int width_px, int height_px,
                       struct display_room *room)
{
    int width, height;
    glfw3.GetFramebufferSize(window->glfw, &width, &height);
    if (!window->x11 || window->drawn_by_caller || width_px != width || height_px != height)
        return false;
    if (window_x11_room(window->x11, width, height, room))
        return true;
    window->direct = false; /* what was seen has gone with its memory */
    return false;
}

/* The X server shows it. */
static void directly_seen(struct window *window)
{
    window_x11_pixels(window->x11, &window->image_width_px, &window->image_height_px);
    window->direct = true;
    window->channels = 0; /* there is no texture of this size */
    window->stale = false;
}

void window_room_show(struct window *window)
{
    window_x11_put(window->x11);
    directly_seen(window);
}

bool window_shared_show(struct window *window, const struct picture_room *room,
                        const uint8_t *pixels, int width_px, int height_px)
{
    int width, height;
    glfw3.GetFramebufferSize(window->glfw, &width, &height);
    if (!window->x11 || window->drawn_by_caller || width_px != width || height_px != height ||
        !window_x11_share(window->x11, room->descriptor, room->at) ||
        !window_x11_put_shared(window->x11, pixels, width, height))
        return false;
    directly_seen(window);
    return true;
}

void window_settle(struct window *window)
{
    if (window->x11)
        window_x11_settle(window->x11);
}

/* True: the server shows it as it is. */
static bool directly_shown(struct window *window, const struct display_image *image)
{
    struct display_room room;
    if (image->channels != 3 ||
        !window_room_begin(window, image->width_px, image->height_px, &room))
        return false;
    for (int row = 0; row < image->height_px; row++)
        row_keep(image->pixels + 3 * (size_t)image->width_px * (size_t)row,
                 room.pixels + (size_t)row * room.stride, image->width_px);
    window_room_show(window);
    return true;
}

void window_draw(struct window *window)
{
    const struct gl *gl = &window->gl;
    int width, height;
    window->stale = false;
    if (window->drawn_by_caller)
        return;
    glfw3.GetFramebufferSize(window->glfw, &width, &height);
    if (width < 1 || height < 1)
        return; /* an icon now */
    if (window->direct && width == window->image_width_px &&
        height == window->image_height_px) {
        window_x11_put_again(window->x11);
        return;
    }
    glfw3.MakeContextCurrent(window->glfw);
    if (window->direct)
        texture_from_direct(window);
    gl->Viewport(0, 0, width, height);
    gl->ClearColor(0, 0, 0, 1);
    gl->Clear(GL_COLOR_BUFFER_BIT);
    if (window->channels) {
        double scale = fmin((double)width / window->image_width_px,
                            (double)height / window->image_height_px);
        int shown_width = (int)lround(window->image_width_px * scale);
        int shown_height = (int)lround(window->image_height_px * scale);
        shown_width = shown_width < 1 ? 1 : shown_width;
        shown_height = shown_height < 1 ? 1 : shown_height;
        gl->Viewport((width - shown_width) / 2,
                     height - shown_height - (height - shown_height) / 2, shown_width,
                     shown_height);
        gl->Enable(GL_TEXTURE_2D);
        gl->BindTexture(GL_TEXTURE_2D, window->texture);
        filter_choose(window, scale);
        if (window->channels == 4)
            gl->Enable(GL_BLEND);
        rectangle_draw(gl);
        gl->Disable(GL_BLEND);
    }
    if (window->repeat)
        window_repeat_show(window->repeat);
    glfw3.SwapBuffers(window->glfw);
}

enum display_status window_show(struct window *window, const struct display_image *image)
{
    static const struct {
        GLint kept;
        GLenum given;
    } formats[] = {[1] = {GL_LUMINANCE8, GL_LUMINANCE},
                   [3] = {GL_RGB8, GL_RGB},
                   [4] = {GL_RGBA8, GL_RGBA}};
    const struct gl *gl = &window->gl;
    if (!image->pixels || image->width_px < 1 || image->height_px < 1 ||
        image->width_px > window->side_max_px || image->height_px > window->side_max_px ||
        (image->channels != 1 && image->channels != 3 && image->channels != 4))
        return display_fail(DISPLAY_BAD_ARGUMENT,
                            "this display shows images of 1..%d pixels on a side with 1, 3 or "
                            "4 channels (got %dx%d with %d%s)",
                            window->side_max_px, image->width_px, image->height_px,
                            image->channels, image->pixels ? "" : ", and no pixels");
    if (directly_shown(window, image))
        return DISPLAY_OK;
    glfw3.MakeContextCurrent(window->glfw);
    window->direct = false;
    gl->BindTexture(GL_TEXTURE_2D, window->texture);
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    if (image->width_px == window->image_width_px &&
        image->height_px == window->image_height_px && image->channels == window->channels)
        gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, image->width_px, image->height_px,
                          formats[image->channels].given, GL_UNSIGNED_BYTE, image->pixels);
    else
        gl->TexImage2D(GL_TEXTURE_2D, 0, formats[image->channels].kept, image->width_px,
                       image->height_px, 0, formats[image->channels].given, GL_UNSIGNED_BYTE,
                       image->pixels);
    if (gl->GetError() != GL_NO_ERROR) {
        window->channels = 0;
        return display_fail(DISPLAY_NO_MEMORY,
                            "the display has no memory for an image of %dx%d pixels",
                            image->width_px, image->height_px);
    }
    window->image_width_px = image->width_px;
    window->image_height_px = image->height_px;
    window->channels = image->channels;
    window->mipmaps = false;
    window_draw(window);
    return DISPLAY_OK;
}

/* ---- waiting ---- */

/* GLFW before 3.4 wakes itself through X11's server, which takes processor time from the
 * program whose pictures are shown. So on X11 a descriptor is waited for, too. */
static struct {
    atomic_bool begun; /* GLFW is there */
    int descriptor;    /* -1: GLFW wakes */
    void *display;
} waking = {.descriptor = -1};

void window_wakes(void *x11_display)
{
    if (waking.begun)
        return;
    waking.display = x11_display;
    waking.descriptor = x11_display ? eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK) : -1;
    waking.begun = true;
}

void window_wake(void)
{
    const uint64_t one = 1;
    if (!waking.begun)
        return;
    if (waking.descriptor < 0 || write(waking.descriptor, &one, sizeof one) != sizeof one)
        glfw3.PostEmptyEvent();
}

bool window_wait_or(double wait_s, int descriptor)
{
    struct pollfd readable = {.fd = descriptor, .events = POLLIN};
    if (descriptor < 0 || waking.descriptor < 0) {
        glfw3.WaitEventsTimeout(wait_s);
        return false;
    }
    window_x11_wait(waking.display, descriptor, wait_s);
    glfw3.PollEvents();
    return poll(&readable, 1, 0) > 0;
}

void window_lost_set(void (*lost)(void *context), void *context)
{
    window_x11_lost_set(lost, context);
}

void window_wait(double wait_s)
{
    uint64_t count;
    if (!(wait_s > 0))
        return;
    if (waking.descriptor < 0) {
        glfw3.WaitEventsTimeout(wait_s);
        return;
    }
    window_x11_wait(waking.display, waking.descriptor, wait_s);
    const ssize_t got = read(waking.descriptor, &count, sizeof count);
    (void)got; /* an event of the window's may have ended it */
}

/* ---- what others draw ---- */

void (*(*window_functions(void))(const char *))(void)
{
    return glfw3.GetProcAddress;
}

void window_frame_begin(struct window *window)
{
    glfw3.MakeContextCurrent(window->glfw);
}

void window_frame_end(struct window *window)
{
    window->stale = false;
    if (window->repeat)
        window_repeat_show(window->repeat);
    glfw3.SwapBuffers(window->glfw);
}

double window_scale(const struct window *window)
{
    float x = 1, y = 1;
    glfw3.GetWindowContentScale(window->glfw, &x, &y);
    return x >= SCALE_LEAST ? x : 1;
}

bool window_fullscreen(const struct window *window)
{
    return window->fullscreen;
}

void window_fullscreen_set(struct window *window, bool full)
{
    int *b = window->before;
    if (full == window->fullscreen || window->edgeless)
        return;
    if (full) {
        glfw3.GetWindowPos(window->glfw, &b[0], &b[1]);
        glfw3.GetWindowSize(window->glfw, &b[2], &b[3]);
        if (!screens_fill(window->glfw, screens_at(b[0] + b[2] / 2, b[1] + b[3] / 2)))
            return;
    } else {
        glfw3.SetWindowMonitor(window->glfw, NULL, b[0], b[1], b[2], b[3], GLFW_DONT_CARE);
    }
    window->fullscreen = full;
}

/* ---- sizes, closing, names ---- */

void window_size(const struct window *window, int *width_px, int *height_px)
{
    glfw3.GetFramebufferSize(window->glfw, width_px, height_px);
}

bool window_closing(const struct window *window)
{
    return glfw3.WindowShouldClose(window->glfw) != 0;
}

void window_title_set(struct window *window, const char *title)
{
    glfw3.SetWindowTitle(window->glfw, title);
}
