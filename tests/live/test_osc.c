/* test_osc.c - packets of OSC against bytes written by hand, addresses against a plain matcher,
 * ports, and a stage both ways. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <osc.h>
#include <osc_stage.h>

#include "knobs_scene.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <math.h>
#include <net/if.h>
#include <netinet/in.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

/* ---- packets ---- */

static struct osc_message taken[8];
static int taken_count;

static void take(void *context, const struct osc_message *m)
{
    (void)context;
    assert_true(taken_count < 8);
    taken[taken_count++] = *m;
}

static const char *read_whole(const uint8_t *bytes, size_t count)
{
    taken_count = 0;
    return osc_packet_read(bytes, count, take, NULL);
}

#define FREQUENCY                                                                              \
    "/oscillator/4/frequency\0"                                                                \
    ",f\0\0"                                                                                   \
    "\x43\xdc\0\0"
#define FOO                                                                                    \
    "/foo\0\0\0\0"                                                                             \
    ",iisff\0\0"                                                                               \
    "\0\0\x03\xe8"                                                                             \
    "\xff\xff\xff\xff"                                                                         \
    "hello\0\0\0"                                                                              \
    "\x3f\x9d\xf3\xb6"                                                                         \
    "\x40\xb5\xb2\x2d"

static void packets_are_read_as_the_bytes_say(void **unused)
{
    (void)unused;
    assert_null(read_whole((const uint8_t *)FREQUENCY, sizeof FREQUENCY - 1));
    assert_int_equal(taken_count, 1);
    assert_string_equal(taken[0].address, "/oscillator/4/frequency");
    assert_true(taken[0].count == 1 && taken[0].arguments[0].number == 440);
    assert_null(read_whole((const uint8_t *)FOO, sizeof FOO - 1));
    const struct osc_argument *a = taken[0].arguments;
    assert_true(taken[0].count == 5 && a[0].number == 1000 && a[1].number == -1);
    assert_string_equal(a[2].text, "hello");
    assert_true(fabs(a[3].number - 1.234) < 1e-6 && fabs(a[4].number - 5.678) < 1e-6);
    static const uint8_t all[] =
        "/a\0\0,hdTFNI[i]bs\0\0\0\0\xff\xff\xff\xff\xff\xff\xff\xfe"
        "\x40\x09\x21\xfb\x54\x44\x2d\x18\0\0\0\x07\0\0\0\x02xy\0\0z\0\0";
    assert_null(read_whole(all, sizeof all));
    a = taken[0].arguments;
    assert_int_equal(taken[0].count, 9);
    assert_true(a[0].number == -2 && fabs(a[1].number - M_PI) < 1e-15 && a[2].number == 1 &&
                a[3].number == 0 && a[6].number == 7);
    assert_string_equal(a[8].text, "z");
}

static void bundles_are_read_in_their_order(void **unused)
{
    (void)unused;
    static const uint8_t bundle[] =
        "#bundle\0\0\0\0\0\0\0\0\x01"
        "\0\0\0\x20" FREQUENCY "\0\0\0\x20"
        "#bundle\0\0\0\0\0\0\0\0\x01\0\0\0\x0c/b\0\0,i\0\0\0\0\0\x05";
    assert_null(read_whole(bundle, sizeof bundle - 1));
    assert_int_equal(taken_count, 2);
    assert_string_equal(taken[1].address, "/b");
    assert_true(taken[1].arguments[0].number == 5);
    /* each packet that is cut off is refused whole, unless it ends behind a message of the
     * bundle */
    for (size_t cut = 4; cut < sizeof bundle - 1; cut += 4) {
        const char *why = read_whole(bundle, cut);
        assert_true(cut == 16 || cut == 52 ? !why : why && taken_count == 0);
    }
    for (size_t cut = 4; cut < sizeof FOO - 1; cut += 4) {
        const char *why = read_whole((const uint8_t *)FOO, cut);
        assert_true(cut == 8 ? !why : why && taken_count == 0);
    }
    assert_non_null(read_whole(bundle, 15));
    assert_non_null(read_whole(bundle, 0));
}

static void what_is_written_is_read(void **unused)
{
    (void)unused;
    uint8_t out[256];
    assert_int_equal(osc_message_write(out, sizeof out, "/oscillator/4/frequency", "f", 440.0),
                     sizeof FREQUENCY - 1);
    assert_memory_equal(out, FREQUENCY, sizeof FREQUENCY - 1);
    assert_int_equal(
        osc_message_write(out, sizeof out, "/foo", "iisff", 1000, -1, "hello", 1.234, 5.678),
        sizeof FOO - 1);
    assert_memory_equal(out, FOO, sizeof FOO - 1);
    assert_int_equal(osc_message_write(out, sizeof FOO - 2, "/foo", "iisff", 1000, -1, "hello",
                                       1.234, 5.678),
                     0);
    const struct osc_argument arguments[] = {{.text = "hello"}, {.number = -2.5}, {.text = ""}};
    const size_t count = osc_arguments_write(out, sizeof out, "/a/b", arguments, 3);
    assert_null(read_whole(out, count));
    assert_string_equal(taken[0].address, "/a/b");
    assert_string_equal(taken[0].arguments[0].text, "hello");
    assert_true(taken[0].count == 3 && taken[0].arguments[1].number == -2.5 &&
                !*taken[0].arguments[2].text);
    assert_int_equal(osc_arguments_write(out, count - 1, "/a/b", arguments, 3), 0);
}

static void bundles_are_written(void **unused)
{
    (void)unused;
    static const uint8_t wanted[] = "#bundle\0\0\0\0\0\0\0\0\x01"
                                    "\0\0\0\x20" FREQUENCY "\0\0\0\x0c/b\0\0,i\0\0\0\0\0\x05";
    uint8_t out[sizeof wanted - 1];
    size_t used = osc_bundle_add(out, sizeof out, 0, "/oscillator/4/frequency", "f", 440.0);
    assert_int_equal(used, 16 + 4 + 32);
    used = osc_bundle_add(out, sizeof out, used, "/b", "i", 5);
    assert_int_equal(used, sizeof out);
    assert_memory_equal(out, wanted, sizeof out);
    assert_int_equal(osc_bundle_add(out, sizeof out, used, "/b", "i", 5), 0);
    for (size_t room = 0; room < 52; room++)
        assert_int_equal(osc_bundle_add(out, room, 0, "/oscillator/4/frequency", "f", 440.0),
                         0);
}

/* ---- addresses ---- */

static bool slow_words(const char *p, const char *a);

/* The same by trying everything. */
static bool slow_match(const char *p, const char *a)
{
    if (!*p)
        return !*a;
    if (*p == '*')
        return slow_match(p + 1, a) || (*a && *a != '/' && slow_match(p, a + 1));
    if (*p == '?')
        return *a && *a != '/' && slow_match(p + 1, a + 1);
    if (*p == '{')
        return slow_words(p + 1, a);
    if (*p == '[') {
        const char *end = strchr(p + 1, ']');
        bool not = p[1] == '!', in = false;
        if (!end || !*a || *a == '/')
            return false;
        for (const char *c = p + 1 + not ; c < end; c++)
            if (c[1] == '-' && c + 2 < end) {
                in = in || (*a >= c[0] && *a <= c[2]);
                c += 2;
            } else {
                in = in || *a == *c;
            }
        return in != not &&slow_match(end + 1, a + 1);
    }
    return *p == *a && slow_match(p + 1, a + 1);
}

static bool slow_words(const char *p, const char *a)
{
    const char *end = strchr(p, '}');
    if (!end)
        return false;
    for (;;) {
        const size_t length = strcspn(p, ",}");
        if (strncmp(a, p, length) == 0 && slow_match(end + 1, a + length))
            return true;
        p += length + 1;
        if (p > end)
            return false;
    }
}

static void addresses_match_as_by_trying_all(void **unused)
{
    (void)unused;
    static const char *const pieces[] = {"a",    "b",    "ab",    "*",      "?",
                                         "[ab]", "[!a]", "[a-c]", "{a,bb}", "{ab}",
                                         "{,a}", "/",    "c",     "[",      "{a"};
    static const char *const addresses[] = {"",   "a",   "b",    "ab",     "abc",  "a/b",
                                            "bb", "aab", "abab", "a/bb/c", "cccc", "bab/a"};
    uint32_t state = 7;
    int matched = 0;
    for (int i = 0; i < 200000; i++) {
        char pattern[64] = "";
        for (int k = 0; k <= i % 5; k++) {
            state = state * 1664525 + 1013904223;
            strcat(pattern, pieces[(state >> 16) % (sizeof pieces / sizeof *pieces)]);
        }
        const char *address = addresses[(state >> 8) % (sizeof addresses / sizeof *addresses)];
        const bool want = slow_match(pattern, address);
        matched += want;
        if (osc_address_matches(pattern, address) != want)
            fail_msg("'%s' and '%s': must be %d", pattern, address, want);
    }
    assert_true(matched > 5000);
    char long_one[2000], name[65];
    memset(long_one, 'a', sizeof long_one);
    for (size_t i = 0; i + 1 < sizeof long_one; i += 2)
        long_one[i] = '*';
    long_one[sizeof long_one - 1] = 'b', long_one[sizeof long_one - 2] = '\0';
    memset(name, 'a', 64);
    name[64] = '\0';
    assert_false(osc_address_matches("*", name)); /* 63 are the most */
    name[63] = '\0';
    assert_false(osc_address_matches(long_one, name)); /* soon */
    assert_true(osc_address_matches("*a*a*a*", name));
}

/* ---- ports ---- */

struct wire {
    int socket;
    struct sockaddr_in to;
};

static struct wire wire_to(int port)
{
    struct wire w = {socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0), {.sin_family = AF_INET}};
    struct sockaddr_in at = {.sin_family = AF_INET};
    assert_true(w.socket >= 0);
    at.sin_addr.s_addr = w.to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    w.to.sin_port = htons((uint16_t)port);
    assert_int_equal(bind(w.socket, (struct sockaddr *)&at, sizeof at), 0);
    return w;
}

static int wire_port(const struct wire *w)
{
    struct sockaddr_in at;
    socklen_t bytes = sizeof at;
    assert_int_equal(getsockname(w->socket, (struct sockaddr *)&at, &bytes), 0);
    return ntohs(at.sin_port);
}

static void wire_send(const struct wire *w, const uint8_t *bytes, size_t count)
{
    assert_int_equal(
        sendto(w->socket, bytes, count, 0, (const struct sockaddr *)&w->to, sizeof w->to),
        count);
}

static size_t wire_take(const struct wire *w, uint8_t out[OSC_PACKET_MAX])
{
    struct pollfd ready = {w->socket, POLLIN, 0};
    if (poll(&ready, 1, 300) <= 0)
        return 0;
    const ssize_t count = recv(w->socket, out, OSC_PACKET_MAX, 0);
    return count > 0 ? (size_t)count : 0;
}

/* An address of this computer's in a network; false: it has none. */
static bool own_address(struct sockaddr_in *out)
{
    struct ifaddrs *all, *a;
    bool found = false;
    if (getifaddrs(&all) != 0)
        return false;
    for (a = all; a && !found; a = a->ifa_next)
        if (a->ifa_addr && a->ifa_addr->sa_family == AF_INET &&
            !(a->ifa_flags & IFF_LOOPBACK)) {
            memcpy(out, a->ifa_addr, sizeof *out);
            found = true;
        }
    freeifaddrs(all);
    return found;
}

/* security.md 34: OSC is heard by this computer alone, or from who is named. */
static void strangers_are_not_heard(void **unused)
{
    (void)unused;
    struct osc_port *port;
    uint8_t bytes[OSC_PACKET_MAX];
    struct osc_port_def def = {.listen = "0.0.0.0:0"};
    assert_int_equal(osc_port_open(&def, &port), STAGE_BAD_ARGUMENT); /* nobody is named */
    assert_non_null(strstr(stage_error(), "--osc-from"));
    def.listen = "0";
    assert_int_equal(osc_port_open(&def, &port), STAGE_OK);
    struct sockaddr_in own, to = {.sin_family = AF_INET};
    const int s = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    const bool has_network = own_address(&own);
    own.sin_port = 0;
    if (has_network) { /* the port of this computer is not there for its network */
        to.sin_addr = own.sin_addr;
        to.sin_port = htons((uint16_t)osc_port_number(port));
        assert_int_equal(bind(s, (struct sockaddr *)&own, sizeof own), 0);
        (void)!sendto(s, FREQUENCY, sizeof FREQUENCY - 1, 0, (struct sockaddr *)&to, sizeof to);
        usleep(20000);
        assert_int_equal(osc_port_next(port, bytes, sizeof bytes), 0);
    }
    osc_port_close(port);
    const char *const stranger[] = {"192.0.2.77"};
    def = (struct osc_port_def){.listen = "0.0.0.0:0", .from = stranger, .from_count = 1};
    assert_int_equal(osc_port_open(&def, &port), STAGE_OK);
    struct wire near = wire_to(osc_port_number(port));
    wire_send(&near, (const uint8_t *)FREQUENCY, sizeof FREQUENCY - 1);
    usleep(20000);
    assert_int_equal(osc_port_next(port, bytes, sizeof bytes), sizeof FREQUENCY - 1);
    if (has_network) { /* it comes from this network's address, which nobody named */
        to.sin_port = htons((uint16_t)osc_port_number(port));
        (void)!sendto(s, FREQUENCY, sizeof FREQUENCY - 1, 0, (struct sockaddr *)&to, sizeof to);
        usleep(20000);
        assert_int_equal(osc_port_next(port, bytes, sizeof bytes), 0);
        assert_int_equal(osc_port_dropped(port), 1);
        osc_port_close(port);
        char name[INET_ADDRSTRLEN];
        inet_ntop(AF_INET, &own.sin_addr, name, sizeof name);
        const char *const named[] = {name};
        def.from = named;
        assert_int_equal(osc_port_open(&def, &port), STAGE_OK);
        to.sin_port = htons((uint16_t)osc_port_number(port));
        (void)!sendto(s, FREQUENCY, sizeof FREQUENCY - 1, 0, (struct sockaddr *)&to, sizeof to);
        usleep(20000);
        assert_int_equal(osc_port_next(port, bytes, sizeof bytes), sizeof FREQUENCY - 1);
    }
    close(near.socket);
    close(s);
    osc_port_close(port);
}

static void wrong_addresses_are_refused_in_one_line(void **unused)
{
    (void)unused;
    static const char *const wrong[] = {"",          "port",  "65536",         "-1",
                                        "1x",        ":9000", "host:9000",     "1.2.3:9000",
                                        "[::1]9000", "9000:", "1.2.3.4.5:9000"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct osc_port *port;
        const struct osc_port_def heard = {.listen = wrong[i]}, sent = {.send = wrong[i]};
        assert_int_equal(osc_port_open(&heard, &port), STAGE_BAD_ARGUMENT);
        assert_null(strchr(stage_error(), '\n'));
        assert_int_equal(osc_port_open(&sent, &port), STAGE_BAD_ARGUMENT);
        assert_null(port);
    }
    struct osc_port *port, *other;
    assert_int_equal(osc_port_open(&(struct osc_port_def){.listen = "0"}, &port), STAGE_OK);
    char taken_port[16];
    snprintf(taken_port, sizeof taken_port, "%d", osc_port_number(port));
    assert_int_equal(osc_port_open(&(struct osc_port_def){.listen = taken_port}, &other),
                     STAGE_FAILED);
    assert_non_null(strstr(stage_error(), "cannot be heard"));
    osc_port_close(port);
}

/* ---- a stage ---- */

static char told[500], said_text[100];
static int scene_number;

static void tell(void *context, const char *text)
{
    (void)context;
    snprintf(told, sizeof told, "%s", text);
}

static const char *scene(void *context, int number)
{
    (void)context;
    scene_number = number;
    return number == 9 ? "there is no scene 9" : NULL;
}

static char other_address[64];

static bool other(void *context, const struct osc_message *m)
{
    (void)context;
    snprintf(other_address, sizeof other_address, "%s", m->address);
    return strcmp(m->address, "/mine") == 0;
}

static const char *text(void *context, const char *words)
{
    (void)context;
    snprintf(said_text, sizeof said_text, "%s", words);
    return NULL;
}

#define SEND(wire, osc, ...)                                                                   \
    do {                                                                                       \
        uint8_t out_[OSC_PACKET_MAX];                                                          \
        wire_send(wire, out_, osc_message_write(out_, sizeof out_, __VA_ARGS__));              \
        usleep(5000);                                                                          \
        told[0] = '\0';                                                                        \
        osc_stage_take(osc);                                                                   \
    } while (0)

/* A stage with OSC at a free port, what is sent goes to `heard`. */
static struct osc_stage *osc_open(struct stage *stage, const struct wire *heard)
{
    char to[40];
    snprintf(to, sizeof to, "localhost:%d", wire_port(heard));
    const struct osc_stage_def def = {.port = {.listen = "0", .send = to},
                                      .stage = stage,
                                      .scene = scene,
                                      .text = text,
                                      .other = other,
                                      .tell = tell};
    struct osc_stage *osc;
    assert_int_equal(osc_stage_open(&def, &osc), STAGE_OK);
    return osc;
}

static void a_stage_is_played(void **unused)
{
    (void)unused;
    struct stage *stage = scene_stage();
    struct wire heard = wire_to(9);
    struct osc_stage *osc = osc_open(stage, &heard);
    struct wire w = wire_to(osc_stage_port(osc));
    SEND(&w, osc, "/control/height", "f", 7.5);
    assert_true(scene_values[0] == 7.5 && !told[0]);
    SEND(&w, osc, "/control/height", "f", 11.0);
    assert_true(scene_values[0] == 7.5 && strstr(told, "height must be 0..10"));
    SEND(&w, osc, "/control/height", "f", (double)NAN);
    assert_true(scene_values[0] == 7.5 && strstr(told, "must be a number"));
    SEND(&w, osc, "/along/height", "f", 0.25);
    assert_true(scene_values[0] == 2.5);
    SEND(&w, osc, "/control/way", "s", "round");
    assert_true(scene_values[3] == 2);
    SEND(&w, osc, "/control/lit", "i", 1);
    assert_true(scene_values[2] == 1);
    SEND(&w, osc, "/control/hight", "f", 1.0);
    assert_non_null(strstr(told, "no control 'hight'; there are"));
    SEND(&w, osc, "/hight", "");
    assert_non_null(strstr(told, "there are /control/NAME"));
    assert_string_equal(other_address, "/hight");
    SEND(&w, osc, "/mine", "f", 1.0);
    assert_true(!told[0] && !strcmp(other_address, "/mine"));
    SEND(&w, osc, "/scene", "i", 3);
    assert_int_equal(scene_number, 3);
    SEND(&w, osc, "/scene", "i", 9);
    assert_non_null(strstr(told, "no scene 9"));
    SEND(&w, osc, "/scene", "s", "three");
    assert_non_null(strstr(told, "a number, 1 to 128"));
    SEND(&w, osc, "/knobs", "i", 1);
    assert_non_null(strstr(told, "--knobs FILE"));
    SEND(&w, osc, "/text", "s", "caf\xc3\xa9");
    assert_string_equal(said_text, "caf\xc3\xa9");
    wire_send(&w, (const uint8_t *)"nonsense", 8);
    usleep(5000);
    osc_stage_take(osc);
    assert_non_null(strstr(told, "a packet was dropped"));
    close(w.socket);
    close(heard.socket);
    osc_stage_close(osc);
    stage_destroy(stage);
}

static void a_stage_answers_and_tells(void **unused)
{
    (void)unused;
    struct stage *stage = scene_stage();
    struct wire heard = wire_to(9);
    struct osc_stage *osc = osc_open(stage, &heard);
    struct wire w = wire_to(osc_stage_port(osc));
    uint8_t bytes[OSC_PACKET_MAX];
    SEND(&w, osc, "/along/height", "f", 0.25);
    SEND(&w, osc, "/control/{lit,way}", "i", 1);
    assert_true(scene_values[2] == 1 && scene_values[3] == 1);
    /* what is asked for is answered */
    SEND(&w, osc, "/control/{weight,height}", "");
    for (int i = 0; i < 2; i++) {
        const size_t count = wire_take(&w, bytes);
        assert_true(count > 0);
        assert_null(read_whole(bytes, count));
        assert_string_equal(taken[0].address, i ? "/control/weight" : "/control/height");
        assert_true(taken[0].arguments[0].number == (i ? 100 : 2.5));
    }
    /* what OSC has set is not sent back; all else is sent once, and then what changes */
    osc_stage_tell(osc);
    int sent = 0;
    for (size_t count; (count = wire_take(&heard, bytes)) > 0; sent++) {
        assert_null(read_whole(bytes, count));
        assert_string_not_equal(taken[0].address, "/control/height");
    }
    int controls;
    stage_controls(stage, &controls);
    assert_int_equal(sent, controls - 3);
    osc_stage_tell(osc);
    assert_int_equal(wire_take(&heard, bytes), 0);
    scene_values[0] = 4.25;
    osc_stage_tell(osc);
    assert_null(read_whole(bytes, wire_take(&heard, bytes)));
    assert_true(!strcmp(taken[0].address, "/control/height") &&
                taken[0].arguments[0].number == 4.25);
    osc_stage_sound(osc, &(struct stage_sound){.name = "clank", .strength = 2, .x = 3, .y = 4});
    assert_null(read_whole(bytes, wire_take(&heard, bytes)));
    assert_true(!strcmp(taken[0].address, "/sound/clank") && taken[0].count == 3 &&
                taken[0].arguments[1].number == 3);
    close(w.socket);
    close(heard.socket);
    osc_stage_close(osc);
    stage_destroy(stage);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(packets_are_read_as_the_bytes_say),
        cmocka_unit_test(bundles_are_read_in_their_order),
        cmocka_unit_test(what_is_written_is_read),
        cmocka_unit_test(bundles_are_written),
        cmocka_unit_test(addresses_match_as_by_trying_all),
        cmocka_unit_test(strangers_are_not_heard),
        cmocka_unit_test(wrong_addresses_are_refused_in_one_line),
        cmocka_unit_test(a_stage_is_played),
        cmocka_unit_test(a_stage_answers_and_tells)};
    return cmocka_run_group_tests_name("osc", tests, NULL, NULL);
}
