/* test_picture_stream.c - streams: to a device that the test plays, and through a PipeWire
 * daemon to a program that reads them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <picture_stream_internal.h>

#include "clock.h"
#include "skip.h"
#ifdef LUTETIA_PIPEWIRE
#include "pipewire_reader.h"
#endif

#include <errno.h>
#include <linux/videodev2.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- a device that the test plays ---- */

static struct {
    pthread_mutex_t lock;
    uint32_t caps;       /* of QUERYCAP */
    uint32_t only_width; /* it has pictures of this width only; 0: any */
    size_t row_more;     /* bytes behind each row */
    int open_errno, write_errno;
    bool full; /* its reader is slow */
    struct v4l2_pix_format format;
    struct v4l2_fract rate;
    uint8_t *last;
    int opened, closed, written;
} device = {.lock = PTHREAD_MUTEX_INITIALIZER};

static int device_open(const char *path, int flags)
{
    (void)flags;
    assert_string_equal(path, "/dev/video9");
    pthread_mutex_lock(&device.lock);
    const int error = device.open_errno;
    device.opened += !error;
    pthread_mutex_unlock(&device.lock);
    errno = error;
    return error ? -1 : 1000;
}

static int device_ioctl(int file, unsigned long request, void *argument)
{
    assert_int_equal(file, 1000);
    if (request == VIDIOC_QUERYCAP) {
        struct v4l2_capability *about = argument;
        about->capabilities = device.caps;
        snprintf((char *)about->card, sizeof about->card, "a test");
        return 0;
    }
    if (request == VIDIOC_S_FMT) {
        struct v4l2_format *f = argument;
        assert_int_equal(f->type, V4L2_BUF_TYPE_VIDEO_OUTPUT);
        if (device.only_width)
            f->fmt.pix.width = device.only_width;
        f->fmt.pix.bytesperline += (uint32_t)device.row_more;
        f->fmt.pix.sizeimage = f->fmt.pix.bytesperline * f->fmt.pix.height;
        device.format = f->fmt.pix;
        return 0;
    }
    if (request == VIDIOC_S_PARM) {
        device.rate = ((struct v4l2_streamparm *)argument)->parm.output.timeperframe;
        return 0;
    }
    errno = ENOTTY;
    return -1;
}

static ssize_t device_write(int file, const void *bytes, size_t count)
{
    assert_int_equal(file, 1000);
    pthread_mutex_lock(&device.lock);
    const int error = device.full ? EAGAIN : device.write_errno;
    if (!error) {
        device.last = realloc(device.last, count);
        memcpy(device.last, bytes, count);
        device.written++;
        assert_int_equal(count, device.format.sizeimage);
    }
    pthread_mutex_unlock(&device.lock);
    errno = error;
    return error ? -1 : (ssize_t)count;
}

static int device_close(int file)
{
    assert_int_equal(file, 1000);
    device.closed++;
    return 0;
}

static int device_setup(void **unused)
{
    (void)unused;
    free(device.last);
    const pthread_mutex_t lock = device.lock;
    memset(&device, 0, sizeof device);
    device.lock = lock;
    device.caps = V4L2_CAP_VIDEO_OUTPUT | V4L2_CAP_READWRITE;
    picture_system =
        (struct picture_system){device_open, device_ioctl, device_write, device_close};
    return 0;
}

static int written(void)
{
    pthread_mutex_lock(&device.lock);
    const int count = device.written;
    pthread_mutex_unlock(&device.lock);
    return count;
}

static struct picture_stream_def def_of(const char *text, bool alpha)
{
    struct picture_stream_def def;
    assert_int_equal(picture_stream_read(text, &def), DISPLAY_OK);
    def.alpha = alpha;
    return def;
}

/* Each pixel tells where it is. */
static struct display_image picture_make(const struct picture_stream_def *def, int seed)
{
    struct display_image image = {def->width_px, def->height_px, def->alpha ? 4 : 3, NULL};
    assert_int_equal(display_image_create(&image), DISPLAY_OK);
    for (int i = 0; i < image.width_px * image.height_px * image.channels; i++)
        image.pixels[i] = (uint8_t)(i * 7 + i / 251 + seed);
    return image;
}

static void picture_put(struct picture_stream *s, const struct picture_stream_def *def,
                        int seed)
{
    struct display_image image = picture_make(def, seed);
    assert_int_equal(picture_stream_put(s, &image), DISPLAY_OK);
    display_image_destroy(&image);
}

static void wait_written(int count)
{
    for (int i = 0; i < 1000 && written() < count; i++)
        usleep(5000);
    assert_true(written() >= count);
}

static void words_are_read(void **unused)
{
    struct picture_stream_def def;
    static const char *const wrong[] = {"",
                                        "obs",
                                        "pipewire,",
                                        "pipewire,0x4",
                                        "pipewire,3x4",
                                        "pipewire,320x240x3",
                                        "pipewire,-2x4",
                                        "pipewire,9000x10",
                                        "pipewire,320x240,30,1",
                                        "pipewire,0.5",
                                        "pipewire,241",
                                        "pipewire,nan",
                                        "pipewire,inf",
                                        "video9"};
    (void)unused;
    def = def_of("pipewire", false);
    assert_true(def.width_px == 0 && def.fps == 30);
    def = def_of("/dev/video9,1280x720,59.94", false);
    assert_true(def.width_px == 1280 && def.height_px == 720 && def.fps == 59.94);
    assert_string_equal(def.to, "/dev/video9");
    def = def_of("/dev/video9,25,64x32", false);
    assert_true(def.width_px == 64 && def.fps == 25);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_int_equal(picture_stream_read(wrong[i], &def), DISPLAY_BAD_ARGUMENT);
}

static bool near(double a, double b, double within)
{
    return a > b - within && a < b + within;
}

/* What BT.601 says, in doubles. */
static void device_gets_yuyv(void **unused)
{
    (void)unused;
    const struct picture_stream_def def = def_of("/dev/video9,62x6,25", false);
    struct picture_stream *s;
    device.row_more = 12;
    assert_int_equal(picture_stream_open(&def, &s), DISPLAY_OK);
    assert_true(device.format.width == 62 && device.format.height == 6);
    assert_int_equal(device.format.pixelformat, V4L2_PIX_FMT_YUYV);
    assert_int_equal(device.rate.denominator, 25 * (int)device.rate.numerator);
    picture_put(s, &def, 3);
    wait_written(1);
    picture_stream_close(s);
    assert_true(device.opened == 1 && device.closed == 1);
    struct display_image image = picture_make(&def, 3);
    for (int y = 0; y < 6; y++)
        for (int x = 0; x < 62; x++) {
            const uint8_t *p = image.pixels + 3 * (62 * y + x),
                          *out = device.last + (2 * 62 + 12) * y + 2 * x;
            const uint8_t *q = image.pixels + 3 * (62 * y + (x ^ 1));
            const double r = (p[0] + q[0]) / 2.0, g = (p[1] + q[1]) / 2.0,
                         b = (p[2] + q[2]) / 2.0;
            assert_true(
                near(out[0], 16 + (65.738 * p[0] + 129.057 * p[1] + 25.064 * p[2]) / 256, 1.5));
            assert_true(
                x % 2
                    ? near(out[1], 128 + (112.439 * r - 94.154 * g - 18.285 * b) / 256, 1.5)
                    : near(out[1], 128 + (-37.945 * r - 74.494 * g + 112.439 * b) / 256, 1.5));
        }
    display_image_destroy(&image);
}

static void device_gets_alpha(void **unused)
{
    (void)unused;
    const struct picture_stream_def def = def_of("/dev/video9,8x4", true);
    struct picture_stream *s;
    assert_int_equal(picture_stream_open(&def, &s), DISPLAY_OK);
    assert_int_equal(device.format.pixelformat, V4L2_PIX_FMT_ABGR32);
    picture_put(s, &def, 9);
    wait_written(1);
    picture_stream_close(s);
    struct display_image image = picture_make(&def, 9);
    for (int i = 0; i < 32; i++)
        for (int c = 0; c < 4; c++)
            assert_int_equal(device.last[4 * i + c],
                             image.pixels[4 * i + (c == 3 ? 3 : 2 - c)]);
    display_image_destroy(&image);
}

static void refused(const char *text, const char *words)
{
    const struct picture_stream_def def = def_of(text, false);
    struct picture_stream *s;
    assert_int_equal(picture_stream_open(&def, &s), DISPLAY_IO_FAILED);
    assert_null(s);
    if (!strstr(display_error(), words))
        fail_msg("'%s' does not say '%s'", display_error(), words);
}

static void other_devices_are_refused(void **unused)
{
    (void)unused;
    device.caps = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_READWRITE;
    refused("/dev/video9,8x4", "/dev/video9 (a test) takes no pictures");
    device.caps = V4L2_CAP_VIDEO_OUTPUT | V4L2_CAP_STREAMING;
    refused("/dev/video9,8x4", "takes no pictures");
    device_setup(NULL);
    device.only_width = 640;
    refused("/dev/video9,8x4", "wants pictures of 640x4");
    device.open_errno = ENOENT;
    refused("/dev/video9,8x4", "No such file or directory; `modprobe v4l2loopback`");
    device.open_errno = EACCES;
    refused("/dev/video9,8x4", "Permission denied");
    assert_int_equal(device.opened, device.closed);
    device_setup(NULL);
    const struct picture_stream_def odd = {.to = "/dev/video9",
                                           .width_px = 3,
                                           .height_px = 4,
                                           .fps = 30},
                                    none = {.to = "/dev/video9", .fps = 30};
    struct picture_stream *s;
    assert_int_equal(picture_stream_open(&odd, &s), DISPLAY_BAD_ARGUMENT);
    assert_int_equal(picture_stream_open(&none, &s), DISPLAY_BAD_ARGUMENT);
}

/* Who puts never waits, whatever the device does, and the stream goes on with it. */
static void device_that_goes_away_is_tried_again(void **unused)
{
    (void)unused;
    const struct picture_stream_def def = def_of("/dev/video9,64x64,30", false);
    struct picture_stream *s;
    const char *said;
    assert_int_equal(picture_stream_open(&def, &s), DISPLAY_OK);
    picture_put(s, &def, 1);
    wait_written(1);
    pthread_mutex_lock(&device.lock);
    device.full = true;
    pthread_mutex_unlock(&device.lock);
    for (int i = 0; i < 20; i++)
        picture_put(s, &def, i);
    usleep(50000);
    assert_null(picture_stream_said(s)); /* a slow reader is no error */
    pthread_mutex_lock(&device.lock);
    device.full = false;
    device.write_errno = ENODEV;
    device.open_errno = ENOENT;
    pthread_mutex_unlock(&device.lock);
    picture_put(s, &def, 2);
    for (int i = 0; i < 400 && !(said = picture_stream_said(s)); i++)
        usleep(5000);
    assert_non_null(said);
    assert_non_null(strstr(said, "interrupted: /dev/video9: No such device"));
    assert_int_equal(device.closed, 1);
    pthread_mutex_lock(&device.lock);
    device.write_errno = device.open_errno = 0;
    pthread_mutex_unlock(&device.lock);
    const int before = written();
    for (int i = 0; i < 400 && written() == before; i++) {
        picture_put(s, &def, 5);
        usleep(10000);
    }
    assert_true(written() > before);
    said = picture_stream_said(s);
    assert_non_null(said);
    assert_non_null(strstr(said, "goes on"));
    struct display_image small = {.width_px = 8, .height_px = 8, .channels = 3};
    assert_int_equal(display_image_create(&small), DISPLAY_OK);
    assert_int_equal(picture_stream_put(s, &small), DISPLAY_BAD_ARGUMENT);
    display_image_destroy(&small);
    picture_stream_close(s);
    assert_int_equal(device.opened, device.closed);
}

/* ---- PipeWire ---- */

#ifdef LUTETIA_PIPEWIRE
static char folder[64];
static pid_t daemon_id = -1;

/* Puts a picture 30 times a second until one like it has been read. */
static void reads_what_was_put(bool alpha)
{
    const struct picture_stream_def def = def_of("pipewire,96x64,30", alpha);
    struct picture_stream *s;
    if (picture_stream_open(&def, &s) != DISPLAY_OK)
        fail_msg("%s", display_error());
    struct pipewire_reader *reader = pipewire_reader_open("lutetia", false);
    assert_non_null(reader);
    struct display_image want = picture_make(&def, 40), got = {0};
    int same = 0;
    for (int i = 0; i < 600 && same < 5; i++) {
        picture_put(s, &def, 40);
        usleep(33000);
        if (!pipewire_reader_next(reader, &got))
            continue;
        assert_true(got.width_px == 96 && got.height_px == 64);
        bool equal = true;
        for (int p = 0; p < 96 * 64 && equal; p++)
            for (int c = 0; c < 4 && equal; c++)
                equal = got.pixels[4 * p + c] ==
                        (c < want.channels ? want.pixels[want.channels * p + c] : 255);
        same += equal;
    }
    assert_int_equal(same, 5);
    assert_true(near(pipewire_reader_fps(reader), 30, 1e-6));
    assert_int_equal(pipewire_reader_alpha(reader), alpha);
    assert_null(picture_stream_said(s));
    pipewire_reader_close(reader);
    picture_put(s, &def, 1); /* nobody reads: nothing happens */
    picture_stream_close(s);
    display_image_destroy(&want);
    display_image_destroy(&got);
}

static void pipewire_hands_pictures_out(void **unused)
{
    (void)unused;
    if (daemon_id < 0)
        skip_because("no pipewire daemon");
    reads_what_was_put(false);
    reads_what_was_put(true);
}

static void slow_reader_holds_nobody_up(void **unused)
{
    (void)unused;
    if (daemon_id < 0)
        skip_because("no pipewire daemon");
    const struct picture_stream_def def = def_of("pipewire,640x480,30", false);
    struct picture_stream *s;
    assert_int_equal(picture_stream_open(&def, &s), DISPLAY_OK);
    struct pipewire_reader *reader = pipewire_reader_open("lutetia", true);
    assert_non_null(reader);
    double longest_s = 0;
    for (int i = 0; i < 60; i++) {
        struct display_image image = picture_make(&def, i);
        const double began_s = clock_now_s();
        assert_int_equal(picture_stream_put(s, &image), DISPLAY_OK);
        const double took_s = clock_now_s() - began_s;
        longest_s = took_s > longest_s ? took_s : longest_s;
        display_image_destroy(&image);
        usleep(33000);
    }
    assert_null(picture_stream_said(s));
    pipewire_reader_close(reader);
    picture_stream_close(s);
    assert_true(longest_s < 0.25); /* the reader keeps each for a second */
}

/* The daemon ends: one line; another one: the stream goes on. */
static void daemon_that_ends_is_told(void **unused)
{
    (void)unused;
    if (daemon_id < 0)
        skip_because("no pipewire daemon");
    const struct picture_stream_def def = def_of("pipewire,64x32,30", false);
    struct picture_stream *s;
    const char *said = NULL;
    assert_int_equal(picture_stream_open(&def, &s), DISPLAY_OK);
    pipewire_daemon_end(daemon_id, folder);
    for (int i = 0; i < 200 && !said; i++) {
        picture_put(s, &def, i);
        usleep(20000);
        said = picture_stream_said(s);
    }
    assert_non_null(said);
    assert_non_null(strstr(said, "interrupted: PipeWire"));
    daemon_id = pipewire_daemon_start(folder, sizeof folder);
    assert_true(daemon_id > 0);
    said = NULL;
    for (int i = 0; i < 400 && !said; i++) {
        picture_put(s, &def, i);
        usleep(20000);
        said = picture_stream_said(s);
    }
    assert_non_null(said);
    assert_non_null(strstr(said, "goes on"));
    picture_stream_close(s);
}

static void without_a_daemon_one_line_says_so(void **unused)
{
    (void)unused;
    const struct picture_stream_def def = def_of("pipewire,64x32,30", false);
    struct picture_stream *s;
    if (daemon_id > 0)
        pipewire_daemon_end(daemon_id, folder);
    daemon_id = -1;
    assert_int_equal(picture_stream_open(&def, &s), DISPLAY_IO_FAILED);
    assert_non_null(strstr(display_error(), "no PipeWire runs for this user"));
}
#endif

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(words_are_read),
        cmocka_unit_test_setup(device_gets_yuyv, device_setup),
        cmocka_unit_test_setup(device_gets_alpha, device_setup),
        cmocka_unit_test_setup(other_devices_are_refused, device_setup),
        cmocka_unit_test_setup(device_that_goes_away_is_tried_again, device_setup),
#ifdef LUTETIA_PIPEWIRE
        cmocka_unit_test(pipewire_hands_pictures_out),
        cmocka_unit_test(slow_reader_holds_nobody_up),
        cmocka_unit_test(daemon_that_ends_is_told),
        cmocka_unit_test(without_a_daemon_one_line_says_so),
#endif
    };
#ifdef LUTETIA_PIPEWIRE
    daemon_id = pipewire_daemon_start(folder, sizeof folder);
#endif
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
#ifdef LUTETIA_PIPEWIRE
    if (daemon_id > 0)
        pipewire_daemon_end(daemon_id, folder);
#endif
    free(device.last);
    return failed;
}
