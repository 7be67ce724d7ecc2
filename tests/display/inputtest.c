/* inputtest.c - see inputtest.h. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "inputtest.h"
#include "xorg.h"

#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

static struct inputtest_kind kinds[INPUTTEST_DEVICES];
static int sockets[INPUTTEST_DEVICES];

/* ---- the server ---- */

static void socket_path(const char *folder, int device, char *path, size_t room)
{
    snprintf(path, room, "%s/socket%d", folder, device);
}

static bool config_write(const char *folder, int count)
{
    char path[100];
    snprintf(path, sizeof path, "%s/conf", folder);
    FILE *file = fopen(path, "w");
    if (!file)
        return false;
    fputs("Section \"ServerFlags\"\n Option \"AutoAddDevices\" \"false\"\nEndSection\n"
          "Section \"Device\"\n Identifier \"d\"\n Driver \"dummy\"\n VideoRam 65536\n"
          "EndSection\n"
          "Section \"Monitor\"\n Identifier \"m\"\n HorizSync 5-1000\n VertRefresh 5-200\n"
          " Modeline \"1280x1024\" 108 1280 1328 1440 1688 1024 1025 1028 1066\nEndSection\n"
          "Section \"Screen\"\n Identifier \"s\"\n Device \"d\"\n Monitor \"m\"\n"
          " DefaultDepth 24\n SubSection \"Display\"\n  Depth 24\n  Modes \"1280x1024\"\n"
          " EndSubSection\nEndSection\n"
          "Section \"ServerLayout\"\n Identifier \"l\"\n Screen \"s\"\n",
          file);
    for (int i = 0; i < count; i++)
        fprintf(file, " InputDevice \"%s\"%s\n", kinds[i].name,
                i == count - 1 ? " \"CorePointer\"" : "");
    fputs("EndSection\n", file);
    for (int i = 0; i < count; i++) {
        socket_path(folder, i, path, sizeof path);
        fprintf(file,
                "Section \"InputDevice\"\n Identifier \"%s\"\n Driver \"inputtest\"\n"
                " Option \"SocketPath\" \"%s\"\n Option \"DeviceType\" \"%s\"\n"
                " Option \"PointerHasPressure\" \"%s\"\nEndSection\n",
                kinds[i].name, path, kinds[i].pen ? "PointerAbsoluteProximity" : "Pointer",
                kinds[i].pressure ? "true" : "false");
    }
    return fclose(file) == 0;
}

/* ---- what the driver hears ---- */

/* Its messages: numbers as the machine has them; each begins with its length in bytes and its
 * kind, and axes are those that the mask names. */
enum { HEAR_VERSION, HEAR_SYNC, HEAR_MOTION, HEAR_PROXIMITY, HEAR_BUTTON };
enum { AXES = 64, AXIS_X = 0, AXIS_Y = 1, AXIS_PRESSURE = 4 };
#define AXIS_MOST 65535.0 /* of a place */
#define PRESSURE_MOST 1000.0

struct head {
    uint32_t bytes, kind;
};

struct axes {
    uint32_t both; /* as moved, and as felt */
    uint8_t mask[AXES / 8];
    double moved[AXES], felt[AXES];
};

struct motion {
    struct head head;
    uint32_t absolute;
    struct axes axes;
};

struct button {
    struct head head;
    int32_t absolute, number;
    uint32_t pressed;
    struct axes axes;
};

static bool tell(int device, const void *message, size_t bytes)
{
    return write(sockets[device], message, bytes) == (ssize_t)bytes;
}

/* Until all that was told has happened. */
static void settle(int device)
{
    const struct head wait = {sizeof wait, HEAR_SYNC};
    struct head done;
    assert_true(tell(device, &wait, sizeof wait));
    assert_int_equal(read(sockets[device], &done, sizeof done), sizeof done);
}

static bool device_open(const char *folder, int device)
{
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    struct {
        struct head head;
        uint16_t major, minor;
    } version = {{sizeof version, HEAR_VERSION}, 1, 0}, answer;
    socket_path(folder, device, address.sun_path, sizeof address.sun_path);
    sockets[device] = socket(AF_UNIX, SOCK_STREAM, 0);
    return connect(sockets[device], (struct sockaddr *)&address, sizeof address) == 0 &&
           tell(device, &version, sizeof version) &&
           read(sockets[device], &answer, sizeof answer) == sizeof answer;
}

bool inputtest_start(const char *folder, const struct inputtest_kind *wanted, int count)
{
    memcpy(kinds, wanted, (size_t)count * sizeof *kinds);
    bool ready = config_write(folder, count) && xorg_start(folder);
    for (int i = 0; ready && i < count; i++)
        ready = device_open(folder, i);
    return ready;
}

static void axis_set(struct axes *axes, int axis, double value)
{
    axes->mask[axis / 8] = (uint8_t)(axes->mask[axis / 8] | 1u << axis % 8);
    axes->moved[axis] = axes->felt[axis] = value;
}

void inputtest_move(int device, double x_px, double y_px, double pressure)
{
    struct motion motion = {.head = {sizeof motion, HEAR_MOTION}, .absolute = 1};
    axis_set(&motion.axes, AXIS_X, x_px / INPUTTEST_WIDTH * AXIS_MOST);
    axis_set(&motion.axes, AXIS_Y, y_px / INPUTTEST_HEIGHT * AXIS_MOST);
    if (pressure >= 0)
        axis_set(&motion.axes, AXIS_PRESSURE, pressure * PRESSURE_MOST);
    assert_true(tell(device, &motion, sizeof motion));
    settle(device);
}

void inputtest_push(int device, double right_px, double down_px)
{
    struct motion motion = {.head = {sizeof motion, HEAR_MOTION}};
    axis_set(&motion.axes, AXIS_X, right_px);
    axis_set(&motion.axes, AXIS_Y, down_px);
    assert_true(tell(device, &motion, sizeof motion));
    settle(device);
}

void inputtest_press(int device, bool down)
{
    const struct button button = {.head = {sizeof button, HEAR_BUTTON},
                                  .absolute = kinds[device].pen,
                                  .number = 1,
                                  .pressed = down};
    assert_true(tell(device, &button, sizeof button));
    settle(device);
}
