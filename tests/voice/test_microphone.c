/* test_microphone.c - JACK's microphone, on the test's own JACK server with the dummy driver.
 * It hears the sound that this program plays, and letters in a window follow it. Skips where
 * there is no jackd. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <jack_library.h>
#include <microphone.h>
#include <osc.h>
#include <osc_port.h>
#include <voice.h>

#include "../display/pipewire_reader.h"
#include "../display/scratch.h"
#include "../lutetia/child.h"
#include "../skip.h"
#include "clock.h"
#include "xvfb.h"

#include <fcntl.h>
#include <glob.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#define AUDIO_TYPE "32 bit float mono audio"
enum { RATE_HZ = 48000, PITCH_HZ = 220 };

static char server_name[32];
static const char *lutetia;

/* ---- a sound that is played ---- */

static struct {
    const struct jack_library *jack;
    void *client, *port;
    _Atomic int level; /* thousandths of full scale */
    uint64_t at;
} player;

/* Plays a buzz of ten harmonics: it has a pitch, and an attack at its beginning. */
static int play(uint32_t frames, void *context)
{
    (void)context;
    float *out = player.jack->jack_port_get_buffer(player.port, frames);
    const double level = player.level / 1000.0;
    for (uint32_t i = 0; i < frames; i++, player.at++) {
        double sum = 0;
        for (int k = 1; k <= 10; k++)
            sum += sin(2 * M_PI * PITCH_HZ * k * (double)(player.at % RATE_HZ) / RATE_HZ) / k;
        out[i] = (float)(level * sum / 2);
    }
    return 0;
}

static pid_t jackd_begin(void)
{
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        const int quiet = open("/dev/null", O_RDWR);
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        dup2(quiet, STDOUT_FILENO);
        dup2(quiet, STDERR_FILENO);
        execlp("jackd", "jackd", "--no-realtime", "-n", server_name, "-d", "dummy", "-r",
               "48000", "-p", "512", (char *)NULL);
        _exit(127);
    }
    return child;
}

/* False: there is no jackd, or it does not start here. */
static bool player_begin(pid_t jackd)
{
    const double until_s = clock_now_s() + 5;
    while (!player.client && clock_now_s() < until_s && waitpid(jackd, NULL, WNOHANG) == 0) {
        poll(NULL, 0, 50);
        player.client = player.jack->jack_client_open("player", JACK_NO_START, NULL);
    }
    if (!player.client)
        return false;
    player.port =
        player.jack->jack_port_register(player.client, "out", AUDIO_TYPE, JACK_PORT_OUT, 0);
    assert_non_null(player.port);
    assert_int_equal(player.jack->jack_set_process_callback(player.client, play, NULL), 0);
    assert_int_equal(player.jack->jack_activate(player.client), 0);
    return true;
}

/* Tries to connect the player until the microphone's port exists. */
static void player_connect(void)
{
    const double until_s = clock_now_s() + 10;
    while (player.jack->jack_connect(player.client, "player:out", "lutetia-voice:in") != 0) {
        if (clock_now_s() > until_s)
            fail_msg("there is no port lutetia-voice:in");
        poll(NULL, 0, 20);
    }
}

static void leftovers_remove(void)
{
    char pattern[100];
    glob_t found;
    snprintf(pattern, sizeof pattern, "/dev/shm/jack*%s*", server_name);
    if (glob(pattern, 0, NULL, &found) != 0)
        return;
    for (size_t i = 0; i < found.gl_pathc; i++)
        unlink(found.gl_pathv[i]);
    globfree(&found);
}

/* ---- what is heard ---- */

static size_t hear(struct microphone *m, float *samples, size_t count)
{
    size_t at = 0;
    const double until_s = clock_now_s() + 10;
    while (at < count && clock_now_s() < until_s) {
        at += microphone_take(m, samples + at, count - at);
        poll(NULL, 0, 5);
    }
    return at;
}

static void what_is_played_is_heard(void)
{
    enum { COUNT = RATE_HZ };
    struct microphone *m;
    char why[300];
    float *samples = calloc(COUNT, sizeof *samples);
    struct voice_frame *frames;
    int frames_count;
    if (!microphone_open("jack", &m, why, sizeof why))
        fail_msg("%s", why);
    assert_int_equal(microphone_rate_hz(m), RATE_HZ);
    player_connect();
    player.level = 500;
    (void)hear(m, samples, COUNT / 4); /* until it arrives */
    assert_int_equal(hear(m, samples, COUNT), COUNT);
    assert_int_equal(microphone_lost(m), 0);
    const struct voice_def def = voice_def_default();
    assert_true(voice_frames(&def, samples, COUNT, RATE_HZ, &frames, &frames_count));
    int right = 0;
    for (int i = 10; i < frames_count - 10; i++)
        right += fabs(frames[i].pitch_hz - PITCH_HZ) < 0.02 * PITCH_HZ &&
                 frames[i].level > 0.1 && frames[i].level < 0.6;
    assert_true(right > 0.8 * (frames_count - 20)); /* a busy machine may skip periods */
    player.level = 0;
    (void)hear(m, samples, COUNT / 4);
    assert_true(hear(m, samples, COUNT / 8) > 0);
    for (int i = 0; i < COUNT / 8; i++)
        assert_true(samples[i] == 0);
    free(frames);
    free(samples);
    microphone_close(m);
}

static void recordings_become_pictures(void)
{
    static const char *const ways[] = {"jack", "any"};
    for (int i = 0; i < 2; i++) {
        const char *still = scratch_path("cry.png");
        const pid_t pid = fork();
        assert_true(pid >= 0);
        if (pid == 0) {
            execl(lutetia, lutetia, "voice", "--microphone", ways[i], "Aagh", "--seconds", "1",
                  "--still", still, "--picture", "200x100", (char *)NULL);
            _exit(127);
        }
        player.level = 500;
        player_connect();
        int status;
        assert_int_equal(waitpid(pid, &status, 0), pid);
        assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
        struct display_image image = {0};
        assert_int_equal(display_png_read_rgb(still, &image), DISPLAY_OK);
        display_image_destroy(&image);
        player.level = 0;
    }
}

static long ink_of(Window window)
{
    struct display_image image;
    long ink = 0;
    screen_read(window, &image);
    for (int i = 0; image.pixels && i < 3 * image.width_px * image.height_px; i += 3)
        ink += image.pixels[i] < 128;
    display_image_destroy(&image);
    return ink;
}

/* What is told by OSC: packets without a fault, and what the last ones said. */
struct told {
    double level, pitch_hz, formant_hz[2];
    int frames, attacks, others;
};

static void told_take(void *context, const struct osc_message *m)
{
    struct told *t = context;
    assert_true(m->count >= 1 && m->arguments[0].type == 'f');
    const double value = m->arguments[0].number;
    if (strcmp(m->address, "/voice/level") == 0)
        t->level = value, t->frames++;
    else if (strcmp(m->address, "/voice/pitch") == 0)
        t->pitch_hz = value;
    else if (strcmp(m->address, "/voice/attack") == 0)
        t->attacks++;
    else if (strcmp(m->address, "/voice/formants") == 0 && m->count == 2)
        t->formant_hz[0] = value, t->formant_hz[1] = m->arguments[1].number;
    else
        t->others++;
}

static void told_read(struct osc_port *port, struct told *told)
{
    uint8_t bytes[OSC_PACKET_MAX];
    size_t count;
    while ((count = osc_port_next(port, bytes, sizeof bytes)) > 0)
        assert_null(osc_packet_read(bytes, count, told_take, told));
}

/* Waits until the window's ink is within bounds. What is told meanwhile is read: a socket
 * holds some seconds of it. */
static long ink_wait(Window window, long least, long most, struct osc_port *port,
                     struct told *told)
{
    const double until_s = clock_now_s() + 15;
    long ink = -1;
    while (clock_now_s() < until_s) {
        ink = ink_of(window);
        told_read(port, told);
        if (ink >= least && ink <= most)
            return ink;
        poll(NULL, 0, 20);
    }
    fail_msg("%ld pixels of ink; wanted %ld to %ld", ink, least, most);
    return 0;
}

static bool is_told_loud(const struct told *told)
{
    return told->frames > 5 && told->attacks > 0 && told->level > 0.1 &&
           fabs(told->pitch_hz - PITCH_HZ) < 0.02 * PITCH_HZ;
}

static bool is_told_quiet(const struct told *told)
{
    return told->frames > 5 && told->level < 0.01 && told->pitch_hz == 0;
}

/* Reads until what was told last is so; a busy machine is late. */
static void told_wait(struct osc_port *port, struct told *told,
                      bool (*so)(const struct told *told))
{
    const double until_s = clock_now_s() + 15;
    do {
        poll(NULL, 0, 20);
        told_read(port, told);
    } while (!so(told) && clock_now_s() < until_s);
    if (!so(told))
        fail_msg("told of %d frames and %d attacks, the last one of level %g and %g Hz",
                 told->frames, told->attacks, told->level, told->pitch_hz);
}

static void letters_in_a_window_follow(void)
{
    const struct osc_port_def hears = {.listen = "0"};
    struct osc_port *port;
    char to[16];
    assert_int_equal(osc_port_open(&hears, &port), STAGE_OK);
    snprintf(to, sizeof to, "%d", osc_port_number(port));
    const pid_t pid = fork();
    assert_true(pid >= 0);
    if (pid == 0) {
        execl(lutetia, lutetia, "voice", "--microphone", "jack", "Aagh", "--picture", "480x240",
              "--osc-to", to, (char *)NULL);
        _exit(127);
    }
    Window window = screen_window("voice", 15);
    assert_true(window != 0);
    player_connect();
    struct told quiet = {0}, loud = {0}, end = {0};
    told_wait(port, &quiet,
              is_told_quiet); /* it listens, and what begins now has a beginning */
    (void)ink_wait(window, 0, 50, port, &quiet); /* nothing is heard: nothing is seen */
    player.level = 500;
    const long most = ink_wait(window, 3000, 480 * 240, port, &loud);
    told_wait(port, &loud, is_told_loud);
    assert_in_range(loud.attacks, 1, 3);
    assert_true(loud.others > loud.frames);
    assert_true(loud.formant_hz[0] >= 0 && loud.formant_hz[1] >= loud.formant_hz[0]);
    player.level = 100;
    (void)ink_wait(window, 20, most / 3, port, &end);
    player.level = 500;
    (void)ink_wait(window, most / 2, 480 * 240, port, &end);
    player.level = 0;
    (void)ink_wait(window, 0, 300, port, &end);
    told_wait(port, &end, is_told_quiet);
    osc_port_close(port);
    kill(pid, SIGINT);
    int status;
    assert_int_equal(waitpid(pid, &status, 0), pid);
    assert_true(WIFEXITED(status));
}

#ifdef LUTETIA_PIPEWIRE
/* Waits until a streamed picture of that size has ink within bounds, and returns it. */
static long streamed_wait(struct pipewire_reader *reader, long least, long most)
{
    const double until_s = clock_now_s() + 15;
    struct display_image got = {0};
    long ink = -1;
    while (clock_now_s() < until_s && !(ink >= least && ink <= most)) {
        poll(NULL, 0, 20);
        if (!pipewire_reader_next(reader, &got))
            continue;
        assert_true(got.width_px == 320 && got.height_px == 160);
        ink = 0;
        for (int i = 0; i < 320 * 160; i++)
            ink += got.pixels[4 * i] < 128;
    }
    display_image_destroy(&got);
    if (ink < least || ink > most)
        fail_msg("%ld pixels of ink in the stream; wanted %ld to %ld", ink, least, most);
    return ink;
}

/* Another program reads the letters, in the size that was asked for, not the window's. */
static void letters_in_a_stream_follow(void)
{
    char folder[64];
    const pid_t daemon = pipewire_daemon_start(folder, sizeof folder);
    if (daemon < 0)
        return;
    const pid_t pid = fork();
    assert_true(pid >= 0);
    if (pid == 0) {
        execl(lutetia, lutetia, "voice", "--microphone", "jack", "Aagh", "--picture", "480x240",
              "--stream", "pipewire,320x160,30", (char *)NULL);
        _exit(127);
    }
    assert_true(screen_window("voice", 15) != 0);
    struct pipewire_reader *reader = pipewire_reader_open("lutetia", false);
    assert_non_null(reader);
    player_connect();
    (void)streamed_wait(reader, 0, 50);
    player.level = 500;
    const long loud = streamed_wait(reader, 1500, 320 * 160);
    assert_true(fabs(pipewire_reader_fps(reader) - 30) < 0.01);
    player.level = 100;
    (void)streamed_wait(reader, 10, loud / 3);
    player.level = 0;
    (void)streamed_wait(reader, 0, 150);
    pipewire_reader_close(reader);
    kill(pid, SIGINT);
    int status;
    assert_int_equal(waitpid(pid, &status, 0), pid);
    assert_true(WIFEXITED(status));
    pipewire_daemon_end(daemon, folder);
}
#endif

/* The window stays, until it is interrupted: one line, and a microphone is looked for. A source
 * that nobody knows ends it. */
static void without_a_server_that_is_said(void **unused)
{
    enum { INTERRUPTED = 124 }; /* timeout's */
    (void)unused;
    const struct {
        const char *way, *said;
        int status;
    } rows[] = {{"jack", "no JACK server runs; it is looked for", INTERRUPTED},
                {"pulse", "PulseAudio", INTERRUPTED},
                {"any", "no microphone: ", INTERRUPTED},
                {"none", "known ones are jack, pulse", 1}};
    setenv("JACK_DEFAULT_SERVER", "lutetia-none", 1);
    setenv("PULSE_SERVER", "/nowhere/pulse", 1);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct child child = {.arguments = {"/usr/bin/timeout", "-s", "INT", "8", lutetia,
                                            "voice", "--microphone", rows[i].way, "Aagh"}};
        child_run(&child);
        if (child.status != rows[i].status || !strstr(child.errors, rows[i].said))
            fail_msg("%s: exit %d: %s", rows[i].way, child.status, child.errors);
        assert_true(strchr(child.errors, '\n') == child.errors + strlen(child.errors) - 1);
    }
}

static void sound_goes_through_jack(void **unused)
{
    (void)unused;
    snprintf(server_name, sizeof server_name, "lutetia-v%d", (int)getpid());
    setenv("JACK_DEFAULT_SERVER", server_name, 1);
    if (jack_load(&player.jack) != MIDI_OK)
        skip_because("%s", midi_error());
    const pid_t jackd = jackd_begin();
    if (!player_begin(jackd)) {
        kill(jackd, SIGKILL);
        waitpid(jackd, NULL, 0);
        leftovers_remove();
        skip_because("no JACK server can be started here");
    }
    what_is_played_is_heard();
    recordings_become_pictures();
    letters_in_a_window_follow();
#ifdef LUTETIA_PIPEWIRE
    letters_in_a_stream_follow();
#endif
    player.jack->jack_client_close(player.client);
    kill(jackd, SIGTERM);
    waitpid(jackd, NULL, 0);
    leftovers_remove();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_a_server_that_is_said),
        cmocka_unit_test(sound_goes_through_jack),
    };
    lutetia = getenv("LUTETIA");
    if (!lutetia || !screen_start("1000x800"))
        return 77;
    const int failed = cmocka_run_group_tests_name("microphone", tests, NULL, NULL);
    screen_end();
    return failed;
}
