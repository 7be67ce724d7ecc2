/* verb_midi.c - `lutetia midi`: the server of instruments, and small programs that use it. */
#include "help.h"
#include "lutetia.h"
#include "options.h"

#include <latency.h>
#include <midi_client.h>
#include <midi_real_time.h>
#include <midi_server.h>
#include <midi_song.h>
#include <midi_time.h>
#include <patience.h>
#include <sound.h>
#include <visible_text.h>

#include <glob.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { LOOK_MS = 100, TEXT_MAX = 33000 };

struct midi_verb {
    const char *name; /* "midi play" */
    const char *address, *device, *filters, *output, *font;
    int tcp_port, count;
    double seconds;
    bool usual_priority, may_sleep, terminals_first;
    struct option_words words;
};

static int fail_midi(const struct midi_verb *v)
{
    return fail(v->name, "%s", midi_error());
}

static int client_make(const struct midi_verb *v, bool stays, struct midi_client **client)
{
    struct midi_client_def def = midi_client_def_default(v->name);
    def.address = v->address;
    def.token = getenv("LUTETIA_MIDI_TOKEN");
    def.stays = stays;
    return midi_client_open(&def, client) == MIDI_OK ? EXIT_SUCCESS : fail_midi(v);
}

/* ---- serve ---- */

static struct midi_server *serving;

static void serve_stop(int signal_number)
{
    (void)signal_number;
    midi_server_stop(serving);
}

/* What devices, programs and servers are called, and what they say, is shown and does nothing
 * to the terminal. */
static const char *shown(const char *text)
{
    static char line[4 * MIDI_TEXT_MAX];
    visible_text(line, sizeof line, text);
    return line;
}

static void serve_log(void *context, const char *line)
{
    (void)context;
    printf("%s\n", shown(line));
    fflush(stdout);
}

static int serve_do(struct midi_verb *v)
{
    const struct midi_server_def def = {.path = v->address,
                                        .tcp_port = v->tcp_port,
                                        .token = getenv("LUTETIA_MIDI_TOKEN"),
                                        .devices = v->words.words,
                                        .devices_count = v->words.count,
                                        .real_time = !v->usual_priority,
                                        .awake = !v->may_sleep,
                                        .terminals_first = v->terminals_first,
                                        .log = serve_log};
    struct sigaction action = {.sa_handler = serve_stop};
    if (v->tcp_port && !def.token)
        return fail_usage(v->name,
                          "--tcp needs the token that clients must know: put it in the "
                          "environment as LUTETIA_MIDI_TOKEN");
    if (midi_server_create(&def, &serving) != MIDI_OK)
        return fail_midi(v);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    struct sigaction hangup;
    if (sigaction(SIGHUP, NULL, &hangup) == 0 && hangup.sa_handler != SIG_IGN) /* nohup */
        sigaction(SIGHUP, &action, NULL);
    visible_print("listening at %s\n", midi_server_path(serving));
    fflush(stdout);
    midi_server_run(serving);
    midi_server_destroy(serving);
    return EXIT_SUCCESS;
}

/* ---- devices, status ---- */

static void kinds_print(void)
{
    const char *argument, *help, *name;
    glob_t found;
    puts("Devices that `lutetia midi serve` can have:\n");
    for (int i = 0; (name = midi_server_kind(i, &argument, &help)); i++) {
        char left[64];
        snprintf(left, sizeof left, "%s%s%s", name, argument[0] ? ":" : "", argument);
        printf("  %-24s %s\n", left, help);
    }
    if (glob("/dev/snd/midi*", 0, NULL, &found) == 0) {
        puts("\nThis machine has");
        for (size_t i = 0; i < found.gl_pathc; i++)
            printf("  raw:%s\n", shown(found.gl_pathv[i]));
        globfree(&found);
    }
}

/* Text of many lines, piece by piece: a byte takes 4 at most, and no piece ends within a
 * character. */
static void reply_print(const char *text)
{
    enum { PIECE = 1000 };
    char out[4 * PIECE + 1];
    for (size_t rest = strlen(text), count; rest > 0; text += count, rest -= count) {
        count = rest < PIECE ? rest : PIECE;
        while (count > PIECE / 2 && count < rest && ((unsigned char)text[count] & 0xc0) == 0x80)
            count--;
        fwrite(out, 1, visible_text_lines(out, sizeof out, text, count), stdout);
    }
}

static int command_print(const struct midi_verb *v, const char *command)
{
    static char text[TEXT_MAX];
    struct midi_client *client;
    int status = client_make(v, false, &client);
    if (status != EXIT_SUCCESS)
        return status;
    if (midi_client_command(client, command, text, sizeof text) == MIDI_OK)
        reply_print(text);
    else
        status = fail_midi(v);
    midi_client_close(client);
    return status;
}

static int devices_do(struct midi_verb *v)
{
    if (v->words.count) { /* `devices kinds` */
        if (strcmp(v->words.words[0], "kinds") != 0)
            return fail_usage(v->name, "it takes nothing, or 'kinds' (got '%.60s')",
                              v->words.words[0]);
        kinds_print();
        return EXIT_SUCCESS;
    }
    return command_print(v, "devices");
}

static int status_do(struct midi_verb *v)
{
    return command_print(v, "status");
}

/* ---- monitor, record ---- */

static int listen_to(const struct midi_verb *v, struct midi_client **client)
{
    int status = client_make(v, true, client);
    if (status != EXIT_SUCCESS)
        return status;
    if (midi_client_listen(*client, v->device ? v->device : "*", v->filters) == MIDI_OK)
        return EXIT_SUCCESS;
    status = fail_midi(v);
    midi_client_close(*client);
    return status;
}

static void event_print(const struct midi_client *client, const struct midi_client_event *e,
                        uint64_t begin_ns)
{
    const double now_s = (double)(midi_now_ns() - begin_ns) / 1e9;
    char text[MIDI_TEXT_MAX];
    switch (e->kind) {
    case MIDI_CLIENT_MESSAGE: {
        const char *name = midi_client_device_name(client, e->device);
        midi_message_text(&e->message, text);
        printf("%10.6f %-12s %s\n", ((double)e->message.time_ns - (double)begin_ns) / 1e9,
               name ? shown(name) : "?", text);
        break;
    }
    case MIDI_CLIENT_DEVICE:
        printf("%10.6f (device %s)\n", now_s, shown(e->text));
        break;
    case MIDI_CLIENT_LOST:
        printf("%10.6f (%u messages lost: too slow)\n", now_s, e->lost);
        break;
    case MIDI_CLIENT_GONE:
        printf("%10.6f (%s; trying again)\n", now_s, shown(e->text));
        break;
    case MIDI_CLIENT_BACK:
        printf("%10.6f (the server is back)\n", now_s);
        break;
    case MIDI_CLIENT_NOTHING:
        break;
    }
}

static bool goes_on(const struct midi_verb *v, uint64_t begin_ns)
{
    return !interrupted() &&
           (!(v->seconds > 0) || (double)(midi_now_ns() - begin_ns) < 1e9 * v->seconds);
}

static int monitor_do(struct midi_verb *v)
{
    struct midi_client *client;
    struct midi_client_event e;
    interrupt_catch();
    int status = listen_to(v, &client), seen = 0;
    if (status != EXIT_SUCCESS)
        return status;
    const uint64_t begin_ns = midi_now_ns();
    while (status == EXIT_SUCCESS && goes_on(v, begin_ns) && (!v->count || seen < v->count)) {
        if (midi_client_next(client, LOOK_MS, &e) != MIDI_OK)
            status = fail_midi(v);
        seen += e.kind == MIDI_CLIENT_MESSAGE;
        event_print(client, &e, begin_ns);
        if (e.kind == MIDI_CLIENT_NOTHING && fflush(stdout) != 0)
            break; /* main says so */
    }
    midi_client_close(client);
    return status;
}

/* A track for each device, named after it. */
static enum midi_status track_name(struct midi_song *song, const struct midi_client *client,
                                   int device)
{
    const char *name = midi_client_device_name(client, device);
    const struct midi_song_event e = {.track = (uint16_t)device,
                                      .kind = MIDI_SONG_META,
                                      .meta = MIDI_META_TRACK_NAME,
                                      .count = name ? (uint32_t)strlen(name) : 0,
                                      .bytes = (const uint8_t *)name};
    return name ? midi_song_add(song, &e) : MIDI_OK;
}

static int record_loop(const struct midi_verb *v, struct midi_client *client,
                       struct midi_song *song, int *messages)
{
    struct midi_client_event e;
    uint64_t begin_ns = midi_now_ns(), named = 0;
    while (goes_on(v, begin_ns) && (!v->count || *messages < v->count)) {
        if (midi_client_next(client, LOOK_MS, &e) != MIDI_OK)
            return fail_midi(v);
        if (e.kind == MIDI_CLIENT_LOST || e.kind == MIDI_CLIENT_GONE)
            tell(v->name, "%s",
                 e.kind == MIDI_CLIENT_LOST ? "some messages were lost" : e.text);
        if (e.kind != MIDI_CLIENT_MESSAGE)
            continue;
        enum midi_status status = MIDI_OK;
        if (!(named >> e.device & 1))
            status = track_name(song, client, e.device);
        named |= UINT64_C(1) << e.device;
        if (status == MIDI_OK)
            status = midi_song_record(song, e.device, &e.message, begin_ns);
        if (status != MIDI_OK)
            return fail_midi(v);
        ++*messages;
    }
    return EXIT_SUCCESS;
}

static int record_do(struct midi_verb *v)
{
    struct midi_client *client;
    struct midi_song *song;
    const struct midi_song_def def = midi_song_def_default();
    int messages = 0;
    if (v->words.count != 1)
        return fail_usage(v->name, "it takes the name of a file to write, like song.mid");
    interrupt_catch();
    if (midi_song_create(&def, &song) != MIDI_OK)
        return fail_midi(v);
    int status = listen_to(v, &client);
    if (status == EXIT_SUCCESS) {
        status = record_loop(v, client, song, &messages);
        midi_client_close(client);
        if (midi_song_write(song, v->words.words[0]) !=
            MIDI_OK) /* also if the end came unexpectedly */
            status = fail_midi(v);
        else
            visible_print("%d messages in %s\n", messages, v->words.words[0]);
    }
    midi_song_destroy(song);
    return status;
}

/* ---- send, play ---- */

/* Finds the named device, or the first one that can play. -1: an error was printed. */
static int target(const struct midi_verb *v, struct midi_client *client)
{
    char text[4096];
    if (v->device) {
        const int device = midi_client_device(client, v->device);
        if (device < 0)
            fail(v->name, "there is no device '%.60s'; `lutetia midi devices` lists them",
                 v->device);
        return device;
    }
    if (midi_client_command(client, "devices", text, sizeof text) != MIDI_OK) {
        fail_midi(v);
        return -1;
    }
    char *rest = text;
    for (char *line; (line = strsep(&rest, "\n"));)
        if (strstr(line, "out up"))
            return midi_client_device(client, strsep(&line, " "));
    fail(v->name, "no device that plays is there; `lutetia midi devices` lists all");
    return -1;
}

static int send_do(struct midi_verb *v)
{
    struct midi_client *client;
    if (!v->words.count)
        return fail_usage(v->name, "it takes messages, like 'note-on 1 c4 100'");
    for (int i = 0; i < v->words.count; i++) {
        struct midi_message m;
        if (midi_message_read(v->words.words[i], &m) != MIDI_OK)
            return fail_usage(v->name, "%s", midi_error());
    }
    int status = client_make(v, false, &client);
    if (status != EXIT_SUCCESS)
        return status;
    const int device = target(v, client);
    status = device < 0 ? EXIT_FAILED : EXIT_SUCCESS;
    for (int i = 0; i < v->words.count && status == EXIT_SUCCESS; i++) {
        struct midi_message m;
        if (midi_message_read(v->words.words[i], &m) != MIDI_OK ||
            midi_client_send(client, device, &m) != MIDI_OK)
            status = fail_midi(v);
    }
    /* The server ends a client's notes when it disconnects, so the client stays for a while. */
    const uint64_t begin_ns = midi_now_ns();
    interrupt_catch();
    while (status == EXIT_SUCCESS && v->seconds > 0 && goes_on(v, begin_ns))
        poll(NULL, 0, 10);
    if (status == EXIT_SUCCESS && midi_client_command(client, "devices", NULL, 0) != MIDI_OK)
        status = fail_midi(v); /* the answer comes when the device has taken everything */
    midi_client_close(client);
    return status;
}

struct play {
    struct midi_client *client;
    int device;
    enum midi_status status;
};

static void play_take(void *context, const struct midi_message *m)
{
    struct play *p = context;
    if (p->status == MIDI_OK)
        p->status = midi_client_send(p->client, p->device, m);
}

static int play_song(const struct midi_verb *v, struct midi_song *song, struct play *p)
{
    const struct midi_song_info info = midi_song_info(song);
    const uint64_t begin_ns = midi_now_ns();
    struct midi_parser parser;
    midi_parser_init(&parser);
    for (size_t i = 0; i <= info.events_count; i++) {
        struct midi_song_event e = {.time_ns = info.end_ns, .kind = MIDI_SONG_META};
        if (i < info.events_count)
            e = midi_song_event(song, i);
        e.time_ns += begin_ns;
        for (uint64_t now_ns; goes_on(v, begin_ns) && (now_ns = midi_now_ns()) < e.time_ns;) {
            const uint64_t left_ns = e.time_ns - now_ns;
            const struct timespec wait = {0, left_ns < 50000000 ? (long)left_ns : 50000000};
            ppoll(NULL, 0, &wait, NULL);
        }
        if (!goes_on(v, begin_ns))
            break;
        midi_song_play(&e, &parser, play_take, p);
        if (p->status != MIDI_OK)
            return fail_midi(v);
    }
    return midi_client_command(p->client, "devices", NULL, 0) == MIDI_OK ? EXIT_SUCCESS
                                                                         : fail_midi(v);
}

/* As the server does. Returns the descriptor that keeps processors awake; -1: they may
 * sleep. */
static int play_hurry(const struct midi_verb *v)
{
    char said[MIDI_REAL_TIME_TEXT];
    const int awake = v->may_sleep ? -1 : latency_open(LATENCY_PATH);
    if (awake >= 0)
        (void)latency_ask(awake, true);
    if (!v->usual_priority)
        (void)midi_real_time_begin(said);
    return awake;
}

static int play_do(struct midi_verb *v)
{
    struct midi_song *song;
    struct play p = {.status = MIDI_OK};
    if (v->words.count != 1)
        return fail_usage(v->name, "it takes one Standard MIDI File");
    interrupt_catch();
    if (midi_song_read(v->words.words[0], &song) != MIDI_OK)
        return fail_midi(v);
    int status = client_make(v, false, &p.client);
    if (status == EXIT_SUCCESS) {
        p.device = target(v, p.client);
        const int awake = p.device < 0 ? -1 : play_hurry(v);
        status = p.device < 0 ? EXIT_FAILED : play_song(v, song, &p);
        if (awake >= 0)
            close(awake);
        midi_client_close(p.client);
    }
    midi_song_destroy(song);
    return status;
}

/* ---- render ---- */

static bool pressed(void *context)
{
    (void)context;
    return interrupted();
}

static int render_do(struct midi_verb *v)
{
    struct sound_def def = sound_def_default();
    struct midi_song *song;
    if (v->words.count != 1)
        return fail_usage(v->name, "it takes one Standard MIDI File");
    def.font = v->font;
    def.room = true;
    if (midi_song_read(v->words.words[0], &song) != MIDI_OK)
        return fail_midi(v);
    const char *out = v->output ? v->output : "out.wav";
    interrupt_catch();
    patience_set((struct patience){pressed, NULL});
    int status = EXIT_SUCCESS;
    if (sound_render(&def, song, v->seconds, out) != MIDI_OK)
        status = interrupted() ? EXIT_FAILED : fail_midi(v);
    patience_set((struct patience){NULL, NULL});
    midi_song_destroy(song);
    return interrupt_report(v->name, status, out);
}

/* ---- the verb ---- */

static const struct {
    const char *name;
    int (*run)(struct midi_verb *v);
    const char *arguments, *help;
} verbs[] = {
    {"serve", serve_do, "[NAME=]KIND[:ARGUMENT]...",
     "have these devices, for any number of programs"},
    {"devices", devices_do, "[kinds]", "the server's devices; or the kinds that there are"},
    {"status", status_do, "", "devices, programs, rates, latencies"},
    {"monitor", monitor_do, "", "print what arrives"},
    {"send", send_do, "MESSAGE...", "send messages, like 'note-on 1 c4 100'"},
    {"play", play_do, "SONG.mid", "play a Standard MIDI File"},
    {"render", render_do, "SONG.mid", "a Standard MIDI File as sound, to a WAV file"},
    {"record", record_do, "SONG.mid", "write what arrives to a Standard MIDI File"},
};

enum { VERBS_COUNT = sizeof verbs / sizeof *verbs };

/* The table, as the help has it. */
static const struct help_command *commands(void)
{
    static struct help_command out[VERBS_COUNT + 1];
    for (int i = 0; i < VERBS_COUNT; i++)
        out[i] = (struct help_command){verbs[i].name, verbs[i].arguments, verbs[i].help};
    return out;
}

/* Whether the help says that an option is for this verb: "monitor, record: only ...; send:
 * ..."; without verbs it is for all. */
static bool option_is_for(const char *help, const char *verb)
{
    bool named = false;
    const size_t length = strlen(verb);
    for (const char *part = help; part; part = strchr(part, ';'), part += part != NULL) {
        const char *colon = strstr(part, ": ");
        while (*part == ' ')
            part++;
        for (const char *at = part; colon && at < colon;
             at += strcspn(at, ", "), at += strspn(at, ", ")) {
            const size_t word = strcspn(at, ",: ");
            if (word == length && memcmp(at, verb, length) == 0)
                return true;
            named = true;
        }
    }
    return !named;
}

static int effects_check(const char *name, const char *verb, const struct option_row *rows,
                         const struct option_words *words)
{
    for (int i = 0; rows[i].name; i++)
        if (words->given[i] && !option_is_for(rows[i].help, verb))
            return fail_usage(name, "--%s has no effect here: it is for '%s'", rows[i].name,
                              rows[i].help);
    return EXIT_SUCCESS;
}

int verb_midi(int argc, char **argv)
{
    static char name[32];
    struct midi_verb v = {.name = "midi"};
    const struct option_row rows[] = {
        {"server", 's', OPTION_TEXT, "ADDRESS",
         "the server's socket, or 127.0.0.1:PORT (this user's socket)", &v.address, 0, 0, 0},
        {"device", 'd', OPTION_TEXT, "NAME",
         "monitor, record: only what comes from this device; send, play: to which device",
         &v.device, 0, 0, 0},
        {"filter", 'f', OPTION_TEXT, "FILTERS",
         "monitor, record: filters of what arrives, as 'drop=clock channels=1-4'", &v.filters,
         0, 0, 0},
        {"count", 'n', OPTION_INTEGER, "N", "monitor, record: end after so many messages",
         &v.count, 1, 1e9, 0},
        {"seconds", 't', OPTION_NUMBER, "S",
         "monitor, record, play, render: end after so long; send: hold notes so long",
         &v.seconds, 0.001, 1e7, 0},
        {"tcp", 0, OPTION_INTEGER, "PORT",
         "serve: also listen at 127.0.0.1:PORT, for who knows LUTETIA_MIDI_TOKEN", &v.tcp_port,
         1, 65535, 0},
        {"usual-priority", 0, OPTION_FLAG, NULL,
         "serve, play: do not run in real time, even where that is allowed", &v.usual_priority,
         0, 0, 0},
        {"may-sleep", 0, OPTION_FLAG, NULL,
         "serve, play: let processors sleep between messages, even where they can be kept "
         "awake",
         &v.may_sleep, 0, 0, 0},
        {"terminals-first", 0, OPTION_FLAG, NULL,
         "serve: what carries bytes of serial lines and terminals goes before other programs "
         "while messages come (root)",
         &v.terminals_first, 0, 0, 0},
        {"output", 'o', OPTION_TEXT, "FILE.wav", "render: the file that is written (out.wav)",
         &v.output, 0, 0, 0},
        {"soundfont", 0, OPTION_TEXT, "FILE",
         "render: the instruments, an SF2 file (LUTETIA_SOUNDFONT, or the distribution's)",
         &v.font, 0, 0, 0},
        {0}};
    if (argc < 2) {
        help_usage(stderr, "midi", commands());
        return EXIT_USAGE;
    }
    if (!strcmp(argv[1], "--help") || !strcmp(argv[1], "-h"))
        return help_print("midi", rows, commands());
    int i = 0;
    while (i < VERBS_COUNT && strcmp(verbs[i].name, argv[1]) != 0)
        i++;
    if (i == VERBS_COUNT)
        return fail_usage("midi",
                          "there is no verb '%.60s'; known are serve, devices, status, "
                          "monitor, send, play, render, record",
                          argv[1]);
    snprintf(name, sizeof name, "midi %s", verbs[i].name);
    v.name = name;
    if (!options_parse(name, rows, argc - 1, argv + 1, &v.words))
        return EXIT_USAGE;
    if (v.words.help)
        return help_print("midi", rows, commands());
    return effects_check(name, verbs[i].name, rows, &v.words) == EXIT_SUCCESS ? verbs[i].run(&v)
                                                                              : EXIT_USAGE;
}
