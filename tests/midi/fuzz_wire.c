/* fuzz_wire.c - sends random frames, some of them correct, to a server as a client would, and
 * to a client as a server would. Both survive, and the server goes on serving a correct client.
 * With libFuzzer it is the target: its bytes follow the greeting. */
#include <midi_client.h>
#include <midi_server.h>
#include <midi_time.h>
#include <midi_wire.h>

#include "../must.h"
#include "../sample.h"

#include <poll.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

static char folder[64], path[96], false_path[96];
static struct midi_server *server;
static struct midi_client *good;

static void *serve(void *unused)
{
    midi_server_run(server);
    return unused;
}

static struct sockaddr_un name_of(const char *at)
{
    struct sockaddr_un name = {.sun_family = AF_UNIX};
    snprintf(name.sun_path, sizeof name.sun_path, "%s", at);
    return name;
}

static size_t frame_put(uint8_t *bytes, uint8_t kind, uint8_t device, const void *payload,
                        size_t count)
{
    const struct midi_wire_frame f = {
        .count = (uint16_t)count, .kind = kind, .device = device, .number = 1};
    midi_wire_head(&f, bytes);
    memcpy(bytes + MIDI_WIRE_HEAD, payload, count);
    return MIDI_WIRE_HEAD + count;
}

/* ---- bytes to a server ---- */

static void to_server(const uint8_t *bytes, size_t count)
{
    static const char hello[] = MIDI_WIRE_GREETING "\nfuzz\n";
    const struct sockaddr_un name = name_of(path);
    uint8_t greeting[100], back[4096];
    const int file = socket(AF_UNIX, SOCK_STREAM, 0);
    must(file >= 0 && connect(file, (const struct sockaddr *)&name, sizeof name) == 0);
    const size_t length = frame_put(greeting, MIDI_WIRE_HELLO, 0, hello, sizeof hello - 1);
    must(send(file, greeting, length, MSG_NOSIGNAL) == (ssize_t)length);
    (void)!send(file, bytes, count, MSG_NOSIGNAL | MSG_DONTWAIT);
    shutdown(file, SHUT_WR);
    struct pollfd p = {file, POLLIN, 0};
    while (poll(&p, 1, 2000) > 0 && recv(file, back, sizeof back, 0) > 0)
        ; /* until the server has read all and closes */
    close(file);
}

/* Whether a correct client still receives what it sends. */
static void good_is_served(uint8_t note)
{
    struct midi_message m = midi_message_make(0, 0x9f, note & 0x7f, 99);
    struct midi_client_event e;
    must(midi_client_send(good, midi_client_device(good, "quiet"), &m) == MIDI_OK);
    do
        must(midi_client_next(good, 5000, &e) == MIDI_OK && e.kind != MIDI_CLIENT_NOTHING);
    while (e.kind != MIDI_CLIENT_MESSAGE || !midi_message_equal(&e.message, &m));
}

/* ---- bytes to a client ---- */

struct false_server {
    int listening;
    const uint8_t *bytes;
    size_t count;
};

static void *deceive(void *context)
{
    const struct false_server *f = context;
    uint8_t bytes[200], in[2000];
    const int file = accept(f->listening, NULL, NULL);
    must(file >= 0);
    (void)!recv(file, in, sizeof in, 0);
    size_t length = frame_put(bytes, MIDI_WIRE_WELCOME, 255, MIDI_WIRE_GREETING,
                              strlen(MIDI_WIRE_GREETING));
    (void)!send(file, bytes, length, MSG_NOSIGNAL);
    (void)!recv(file, in, sizeof in, 0); /* the first command, whose number is 2 */
    const struct midi_wire_frame reply = {.kind = MIDI_WIRE_REPLY, .number = 2};
    midi_wire_head(&reply, bytes);
    (void)!send(file, bytes, MIDI_WIRE_HEAD, MSG_NOSIGNAL);
    for (size_t at = 0; at < f->count;) {
        const ssize_t sent = send(file, f->bytes + at, f->count - at, MSG_NOSIGNAL);
        if (sent <= 0)
            break;
        at += (size_t)sent;
    }
    close(file);
    return NULL;
}

static void to_client(const uint8_t *bytes, size_t count)
{
    struct sockaddr_un name = name_of(false_path);
    struct false_server f = {socket(AF_UNIX, SOCK_STREAM, 0), bytes, count};
    pthread_t thread;
    unlink(false_path);
    must(f.listening >= 0 && bind(f.listening, (struct sockaddr *)&name, sizeof name) == 0 &&
         listen(f.listening, 1) == 0);
    must(pthread_create(&thread, NULL, deceive, &f) == 0);
    const struct midi_client_def def = {.name = "fuzz", .address = false_path};
    struct midi_client *client;
    struct midi_client_event e;
    /* The first reply may be a refusal. */
    const bool open = midi_client_open(&def, &client) == MIDI_OK;
    must(open || (!client && midi_error()[0]));
    while (open && midi_client_next(client, 5000, &e) == MIDI_OK) {
        must(e.kind != MIDI_CLIENT_NOTHING); /* it comes to an end */
        must(e.kind != MIDI_CLIENT_MESSAGE || midi_message_good(&e.message));
        must(strlen(e.text) < sizeof e.text);
    }
    midi_client_close(client);
    pthread_join(thread, NULL);
    close(f.listening);
}

/* ---- both ---- */

static void begin(void)
{
    static const char *const devices[] = {"loop", "quiet=loop"};
    pthread_t thread;
    snprintf(folder, sizeof folder, "/tmp/lutetia-fuzz-XXXXXX");
    must(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/socket", folder);
    snprintf(false_path, sizeof false_path, "%s/false", folder);
    const struct midi_server_def def = {.path = path, .devices = devices, .devices_count = 2};
    must(midi_server_create(&def, &server) == MIDI_OK);
    must(pthread_create(&thread, NULL, serve, NULL) == 0);
    pthread_detach(thread);
    const struct midi_client_def good_def = {.name = "good", .address = path};
    must(midi_client_open(&good_def, &good) == MIDI_OK &&
         midi_client_listen(good, "quiet", "") == MIDI_OK);
}

#ifdef LUTETIA_FUZZ_TARGET
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    static unsigned int turn;
    if (!server)
        begin();
    to_server(bytes, count);
    to_client(bytes, count);
    if (turn++ % 64 == 0)
        good_is_served((uint8_t)turn);
    return 0;
}
#else

/* Makes frames whose heads are mostly correct, with random payloads. */
static size_t frames_by_chance(uint64_t *seed, uint8_t *bytes, size_t room)
{
    static const char *const words[] = {
        "listen loop drop=clock", "listen * thin=5", "status",     "devices",
        "send loop transpose=3",  "silence loop",    "unlisten *", "listen",
        "loop loop in,out up"};
    static const uint8_t kinds[] = {1, 2, 2, 3, 3, 3, 16, 17, 18, 19, 20};
    size_t at = 0;
    for (uint64_t n = sample_word(seed) % 12; n; n--) {
        const uint64_t any = sample_word(seed);
        uint8_t payload[300];
        size_t count = any % 16 ? any % 4 : any % sizeof payload;
        for (size_t i = 0; i < count; i++)
            payload[i] = (uint8_t)(sample_word(seed) & 0x7f);
        const uint8_t kind =
            any >> 8 & 31 ? kinds[(any >> 16) % sizeof kinds] : (uint8_t)(any >> 24);
        if (kind == 3 && count)
            payload[0] |= 0x80;
        if ((kind == 2 || kind == 17) && any >> 32 & 3) {
            const char *text = words[(any >> 34) % (sizeof words / sizeof *words)];
            count = strlen(text);
            memcpy(payload, text, count);
        }
        if (at + MIDI_WIRE_HEAD + count > room)
            break;
        at += frame_put(bytes + at, kind, any >> 40 & 7 ? any >> 44 & 1 : (uint8_t)(any >> 48),
                        payload, count);
        if (!(any >> 56 & 15)) /* a count that is another one */
            bytes[at - MIDI_WIRE_HEAD - count] ^= (uint8_t)(1u << (any >> 60 & 7));
    }
    return at;
}

int main(void)
{
    enum { TURNS = 400 };
    static uint8_t bytes[4096];
    uint64_t seed = 12;
    begin();
    for (int turn = 0; turn < TURNS; turn++) {
        const size_t count = frames_by_chance(&seed, bytes, sizeof bytes);
        to_server(bytes, count);
        to_client(bytes, count);
        if (turn % 20 == 0)
            good_is_served((uint8_t)(turn / 20));
    }
    midi_client_close(good);
    midi_server_stop(server);
    poll(NULL, 0, 50);
    unlink(path);
    unlink(false_path);
    strcat(path, ".lock");
    unlink(path);
    rmdir(folder);
    printf("%d turns\n", TURNS);
    return 0;
}
#endif
