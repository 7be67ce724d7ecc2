/* picture_stream_v4l2.c - pictures to a loopback device of Video4Linux: its output side takes
 * what is written, and its other side is a camera. */
#include "picture_stream_internal.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/videodev2.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

static int device_file_open(const char *path, int flags)
{
    return open(path, flags);
}

static int system_ioctl(int file, unsigned long request, void *argument)
{
    return ioctl(file, request, argument);
}

struct picture_system picture_system = {device_file_open, system_ioctl, write, close};

struct device {
    int file;
    char path[128];
    bool alpha;
    size_t stride, bytes; /* of a row, of a picture */
    uint8_t *pixels;
};

/* What the device is asked, until no signal comes in between. */
static int ask(int file, unsigned long request, void *argument)
{
    int answer;
    do
        answer = picture_system.ioctl(file, request, argument);
    while (answer != 0 && errno == EINTR);
    return answer;
}

static bool takes_pictures(struct device *d, char *why, size_t room)
{
    struct v4l2_capability about = {0};
    if (ask(d->file, VIDIOC_QUERYCAP, &about) != 0) {
        snprintf(why, room, "%s is no device of Video4Linux (%s)", d->path, strerror(errno));
        return false;
    }
    const uint32_t can =
        about.capabilities & V4L2_CAP_DEVICE_CAPS ? about.device_caps : about.capabilities;
    if (can & V4L2_CAP_VIDEO_OUTPUT && can & V4L2_CAP_READWRITE)
        return true;
    snprintf(why, room,
             "%s (%.32s) takes no pictures: a loopback device does, which "
             "`modprobe v4l2loopback` makes",
             d->path, (const char *)about.card);
    return false;
}

static bool format_set(struct device *d, const struct picture_stream_def *def, char *why,
                       size_t room)
{
    const uint32_t wanted = def->alpha ? V4L2_PIX_FMT_ABGR32 : V4L2_PIX_FMT_YUYV;
    const uint32_t width = (uint32_t)def->width_px, height = (uint32_t)def->height_px;
    const uint32_t stride = width * (def->alpha ? 4 : 2);
    struct v4l2_format format = {.type = V4L2_BUF_TYPE_VIDEO_OUTPUT,
                                 .fmt.pix = {.width = width,
                                             .height = height,
                                             .pixelformat = wanted,
                                             .field = V4L2_FIELD_NONE,
                                             .bytesperline = stride,
                                             .sizeimage = stride * height,
                                             .colorspace = def->alpha
                                                               ? V4L2_COLORSPACE_SRGB
                                                               : V4L2_COLORSPACE_SMPTE170M}};
    const struct v4l2_pix_format *pix = &format.fmt.pix;
    if (ask(d->file, VIDIOC_S_FMT, &format) != 0) {
        snprintf(why, room, "%s takes no pictures of %dx%d pixels (%s)", d->path, def->width_px,
                 def->height_px, strerror(errno));
        return false;
    }
    if (pix->width != width || pix->height != height || pix->pixelformat != wanted) {
        snprintf(why, room,
                 "%s wants pictures of %ux%u pixels as %.4s (wanted %dx%d as %.4s): say its "
                 "size, or end the program that reads it",
                 d->path, pix->width, pix->height, (const char *)&pix->pixelformat,
                 def->width_px, def->height_px, (const char *)&wanted);
        return false;
    }
    d->stride = pix->bytesperline > stride ? pix->bytesperline : stride;
    d->bytes = d->stride * height;
    d->bytes = pix->sizeimage > d->bytes ? pix->sizeimage : d->bytes;
    return true;
}

static void device_close(void *own)
{
    struct device *d = own;
    if (d->file >= 0)
        picture_system.close(d->file);
    free(d->pixels);
    free(d);
}

static bool device_open(const struct picture_stream_def *def, void **own, char *why,
                        size_t room)
{
    struct device *d = calloc(1, sizeof *d);
    *own = NULL;
    if (!d) {
        snprintf(why, room, "no memory for a stream");
        return false;
    }
    snprintf(d->path, sizeof d->path, "%s", def->to);
    d->alpha = def->alpha;
    d->file = picture_system.open(d->path, O_RDWR | O_NONBLOCK | O_CLOEXEC);
    bool ok = d->file >= 0;
    if (!ok)
        snprintf(why, room, "%s: %s%s", d->path, strerror(errno),
                 errno == ENOENT ? "; `modprobe v4l2loopback` makes such devices" : "");
    ok = ok && takes_pictures(d, why, room) && format_set(d, def, why, room);
    if (ok) { /* its rate is for readers; some devices take none */
        struct v4l2_streamparm parm = {.type = V4L2_BUF_TYPE_VIDEO_OUTPUT};
        parm.parm.output.timeperframe =
            (struct v4l2_fract){1000, (uint32_t)lround(1000 * def->fps)};
        ask(d->file, VIDIOC_S_PARM, &parm);
    }
    if (ok && !(d->pixels = calloc(1, d->bytes))) {
        snprintf(why, room, "no memory for pictures of %zu bytes", d->bytes);
        ok = false;
    }
    if (ok)
        *own = d;
    else
        device_close(d);
    return ok;
}

/* Two pixels at a time: their brightnesses, and the mean's colour. BT.601, limited range. */
static void row_yuyv(const uint8_t *rgb, uint8_t *out, int width)
{
    for (int x = 0; x < width; x += 2, rgb += 6, out += 4) {
        const int r = rgb[0] + rgb[3], g = rgb[1] + rgb[4], b = rgb[2] + rgb[5];
        out[0] = (uint8_t)(((66 * rgb[0] + 129 * rgb[1] + 25 * rgb[2] + 128) >> 8) + 16);
        out[1] = (uint8_t)(((-38 * r - 74 * g + 112 * b + 256) >> 9) + 128);
        out[2] = (uint8_t)(((66 * rgb[3] + 129 * rgb[4] + 25 * rgb[5] + 128) >> 8) + 16);
        out[3] = (uint8_t)(((112 * r - 94 * g - 18 * b + 256) >> 9) + 128);
    }
}

static void row_bgra(const uint8_t *rgba, uint8_t *out, int width)
{
    for (int x = 0; x < width; x++, rgba += 4, out += 4) {
        out[0] = rgba[2];
        out[1] = rgba[1];
        out[2] = rgba[0];
        out[3] = rgba[3];
    }
}

static bool device_send(void *own, const struct display_image *image, char *why, size_t room)
{
    struct device *d = own;
    const size_t row_bytes = (size_t)image->width_px * (size_t)image->channels;
    for (int y = 0; y < image->height_px; y++)
        (d->alpha ? row_bgra : row_yuyv)(image->pixels + row_bytes * (size_t)y,
                                         d->pixels + d->stride * (size_t)y, image->width_px);
    ssize_t count;
    do
        count = picture_system.write(d->file, d->pixels, d->bytes);
    while (count < 0 && errno == EINTR);
    if (count == (ssize_t)d->bytes || (count < 0 && errno == EAGAIN))
        return true; /* EAGAIN: its reader is slow; this picture is left out */
    snprintf(why, room, "%s: %s", d->path,
             count < 0 ? strerror(errno) : "it took a part of a picture");
    return false;
}

const struct picture_way picture_way_v4l2 = {device_open, device_send, device_close};
