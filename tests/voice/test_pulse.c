/* test_pulse.c - PulseAudio's microphone, on the test's own server, whose only source is the
 * monitor of its only sink. It hears the buzz that is played, and notices when the server ends.
 * Skips where there is no pulseaudio. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <microphone.h>
#include <voice.h>

#include "../display/scratch.h"
#include "../skip.h"
#include "clock.h"

#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

enum { RATE_HZ = 48000, PITCH_HZ = 220, SECONDS = 5 };

static char socket_option[300], server_address[300];

static void quiet_begin(void)
{
    const int quiet = open("/dev/null", O_RDWR);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    dup2(quiet, STDOUT_FILENO);
    dup2(quiet, STDERR_FILENO);
}

static pid_t pulseaudio_begin(void)
{
    const char *folder = scratch_path("pulse");
    snprintf(socket_option, sizeof socket_option,
             "module-native-protocol-unix auth-anonymous=1 socket=%s.socket", folder);
    snprintf(server_address, sizeof server_address, "unix:%s.socket", folder);
    setenv("PULSE_SERVER", server_address, 1);
    setenv("HOME", scratch_path("."), 1);
    unsetenv("XDG_RUNTIME_DIR");
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        quiet_begin();
        execlp("pulseaudio", "pulseaudio", "-n", "--daemonize=no", "--exit-idle-time=-1",
               "--use-pid-file=no", "-L", "module-null-sink sink_name=room rate=48000", "-L",
               socket_option, (char *)NULL);
        _exit(127);
    }
    return child;
}

/* Starts playing SECONDS of a buzz of ten harmonics; does not wait. */
static pid_t player_begin(void)
{
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    const pid_t pacat = fork();
    assert_true(pacat >= 0);
    if (pacat == 0) {
        dup2(ends[0], STDIN_FILENO);
        close(ends[0]);
        close(ends[1]);
        quiet_begin();
        execlp("pacat", "pacat", "--playback", "--raw", "--format=float32le", "--rate=48000",
               "--channels=1", "--latency-msec=50", (char *)NULL);
        _exit(127);
    }
    close(ends[0]);
    const pid_t writer = fork();
    assert_true(writer >= 0);
    if (writer == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        for (int i = 0; i < SECONDS * RATE_HZ; i++) {
            double sum = 0;
            for (int k = 1; k <= 10; k++)
                sum += sin(2 * M_PI * PITCH_HZ * k * i / RATE_HZ) / k;
            const float sample = (float)(0.25 * sum);
            if (write(ends[1], &sample, sizeof sample) != sizeof sample)
                break;
        }
        _exit(0);
    }
    close(ends[1]);
    return pacat;
}

/* Opens a microphone as soon as the server runs; NULL: there is no server. */
static struct microphone *microphone_wait(pid_t pulseaudio)
{
    const double until_s = clock_now_s() + 10;
    struct microphone *m = NULL;
    char why[300];
    while (!microphone_open("pulse", &m, why, sizeof why)) {
        if (clock_now_s() > until_s || waitpid(pulseaudio, NULL, WNOHANG) != 0)
            return NULL;
        poll(NULL, 0, 50);
    }
    return m;
}

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

/* Plays, and hears two seconds from the sound's beginning on. The share of frames that have its
 * pitch; 0: it did not come. */
static double share_heard(struct microphone *m)
{
    enum { COUNT = 2 * RATE_HZ };
    float *samples = calloc(COUNT, sizeof *samples);
    struct voice_frame *frames = NULL;
    int count = 0, right = 0;
    const uint64_t lost = microphone_lost(m);
    const double until_s = clock_now_s() + 10;
    const pid_t player = player_begin();
    bool came = false;
    while (!came && clock_now_s() < until_s && hear(m, samples, 480) == 480)
        came = fabsf(samples[100]) >= 0.01f || fabsf(samples[300]) >= 0.01f;
    if (came && hear(m, samples, COUNT) == COUNT && microphone_lost(m) == lost) {
        const struct voice_def def = voice_def_default();
        assert_true(voice_frames(&def, samples, COUNT, RATE_HZ, &frames, &count));
        for (int i = 10; i < count - 10; i++)
            right +=
                fabs(frames[i].pitch_hz - PITCH_HZ) < 0.02 * PITCH_HZ && frames[i].level > 0.1;
    }
    kill(player, SIGKILL);
    waitpid(player, NULL, 0);
    free(frames);
    free(samples);
    return count > 20 ? (double)right / (count - 20) : 0;
}

static void server_end(pid_t pulseaudio)
{
    kill(pulseaudio, SIGKILL);
    waitpid(pulseaudio, NULL, 0);
}

static void children_reap(void)
{
    while (waitpid(-1, NULL, WNOHANG) > 0)
        continue;
}

static bool gone_at_last(struct microphone *m)
{
    float rest[480];
    const double until_s = clock_now_s() + 30;
    while (!microphone_gone(m) && clock_now_s() < until_s) {
        (void)microphone_take(m, rest, 480);
        poll(NULL, 0, 1);
    }
    return microphone_gone(m);
}

/* A busy machine may leave some out: then it is played again. */
static void what_is_played_is_heard(void **unused)
{
    (void)unused;
    const pid_t pulseaudio = pulseaudio_begin();
    struct microphone *m = microphone_wait(pulseaudio);
    if (!m) {
        skip_because("no PulseAudio server can be started here");
    }
    assert_int_equal(microphone_rate_hz(m), RATE_HZ);
    double share = 0;
    for (int attempt = 0; attempt < 4 && share <= 0.8; attempt++) {
        const double heard = share_heard(m);
        print_message("%.0f%% of the frames were heard\n", 100 * heard);
        share = heard > share ? heard : share;
    }
    assert_true(share > 0.8);
    server_end(pulseaudio);
    assert_true(gone_at_last(m));
    microphone_close(m);
    children_reap();
}

/* A server ends when it has just sent much at once, which the microphones still read: all
 * notice, and can be closed. */
static void a_server_that_ends_is_noticed(void **unused)
{
    enum { MICROPHONES = 12, SERVERS = 4 };
    struct microphone *m[MICROPHONES];
    char why[300];
    (void)unused;
    for (int server = 0; server < SERVERS; server++) {
        const pid_t pulseaudio = pulseaudio_begin();
        m[0] = microphone_wait(pulseaudio);
        if (!m[0]) {
            skip_because("no PulseAudio server can be started here");
        }
        for (int i = 1; i < MICROPHONES; i++)
            assert_true(microphone_open("pulse", &m[i], why, sizeof why));
        const pid_t player = player_begin();
        float samples[RATE_HZ / 4];
        for (int i = 0; i < MICROPHONES; i++)
            hear(m[i], samples, 480);
        kill(pulseaudio, SIGSTOP);
        poll(NULL, 0, 200);
        kill(pulseaudio, SIGCONT);
        poll(NULL, 0, 3 + 2 * server);
        server_end(pulseaudio);
        for (int i = 0; i < MICROPHONES; i++)
            assert_true(gone_at_last(m[i]));
        for (int i = 0; i < MICROPHONES; i++)
            microphone_close(m[i]);
        kill(player, SIGKILL);
        waitpid(player, NULL, 0);
        children_reap();
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_is_played_is_heard),
                                       cmocka_unit_test(a_server_that_ends_is_noticed)};
    return cmocka_run_group_tests_name("pulse", tests, NULL, NULL);
}
