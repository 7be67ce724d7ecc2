/* server_commands.c - see server_commands.h. */
#include "server_commands.h"
#include "server_route.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

struct reply {
    char text[MIDI_WIRE_REPLY_MAX];
    size_t count;
    bool wrong;
};

__attribute__((format(printf, 2, 3))) static void say(struct reply *r, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int count =
        vsnprintf(r->text + r->count, sizeof r->text - r->count, format, arguments);
    va_end(arguments);
    r->count += count < 0 ? 0 : (size_t)count;
    r->count = r->count < sizeof r->text ? r->count : sizeof r->text - 1;
}

void command_device_text(const struct server_device *d, char text[static 160])
{
    snprintf(text, 160, "%s %s %s %s", d->name, d->kind->name,
             d->hears && d->plays ? "in,out"
             : d->plays           ? "out"
                                  : "in",
             d->up ? "up" : "down");
}

/* The devices of that name, or all for *: a bit each. 0: none, and the error was sent. */
static uint32_t devices_named(const struct midi_server *s, const char *name, struct reply *r)
{
    uint32_t found = 0;
    for (int i = 0; i < s->devices_count; i++)
        if (!strcmp(name, "*") || !strcmp(name, s->devices[i]->name))
            found |= UINT32_C(1) << i;
    if (found)
        return found;
    r->wrong = true;
    say(r, "there is no device '%.60s'; known are ", name);
    for (int i = 0; i < s->devices_count; i++)
        say(r, "%s%s", i ? ", " : "", s->devices[i]->name);
    say(r, "%s", s->devices_count ? "" : "none: the server was started without");
    return 0;
}

/* ---- commands ---- */

static void filters_do(struct midi_server *s, struct server_client *c, char *text,
                       struct reply *r, bool out)
{
    char *filters = text;
    const char *name = strsep(&filters, " ");
    const uint32_t devices = devices_named(s, name, r);
    for (int i = 0; i < s->devices_count && !r->wrong; i++) {
        struct midi_chain *chain;
        if (!(devices >> i & 1))
            continue;
        if (midi_chain_create(filters ? filters : "", &chain) != MIDI_OK) {
            r->wrong = true;
            say(r, "%s", midi_error());
        } else if (out) {
            route_send_filter(s, c, i, chain);
        } else {
            route_hear(s, c, i, chain);
        }
    }
}

static void listen_do(struct midi_server *s, struct server_client *c, char *text,
                      struct reply *r)
{
    filters_do(s, c, text, r, false);
}

static void send_do(struct midi_server *s, struct server_client *c, char *text, struct reply *r)
{
    filters_do(s, c, text, r, true);
}

static void unlisten_do(struct midi_server *s, struct server_client *c, char *text,
                        struct reply *r)
{
    const uint32_t devices = devices_named(s, text, r);
    for (int i = 0; i < s->devices_count; i++)
        if (devices >> i & 1)
            route_hear(s, c, i, NULL);
}

static void silence_take(void *context, const struct midi_message *m)
{
    (void)device_put(context, m);
}

static void silence_do(struct midi_server *s, struct server_client *c, char *text,
                       struct reply *r)
{
    const uint32_t devices = devices_named(s, text, r);
    (void)c;
    for (int i = 0; i < s->devices_count; i++)
        if (devices >> i & 1) {
            midi_notes_silence(midi_now_ns(), silence_take, s->devices[i]);
            device_write_out(s->devices[i]);
        }
}

static void devices_do(struct midi_server *s, struct server_client *c, char *text,
                       struct reply *r)
{
    (void)c;
    (void)text;
    for (int i = 0; i < s->devices_count; i++) {
        const struct server_device *d = s->devices[i];
        char line[160];
        command_device_text(d, line);
        say(r, "%s%s%s\n", line, d->up ? "" : ": ", d->why);
    }
}

static void latency_say(const struct midi_histogram *h, struct reply *r)
{
    static const uint64_t edges_us[] = {0,    20,   50,   100,   200,   500,
                                        1000, 2000, 5000, 20000, 100000};
    enum { EDGES = sizeof edges_us / sizeof *edges_us };
    say(r,
        "latency: %llu deliveries, p50 %.0f us, p99 %.0f us, p99.9 %.0f us, longest %.0f us\n",
        (unsigned long long)h->count, midi_histogram_part(h, 0.5) / 1e3,
        midi_histogram_part(h, 0.99) / 1e3, midi_histogram_part(h, 0.999) / 1e3,
        (double)h->most_ns / 1e3);
    for (int i = 0; i < EDGES && h->count; i++) {
        const uint64_t to_ns = i + 1 < EDGES ? edges_us[i + 1] * 1000 : UINT64_MAX;
        const uint64_t count = midi_histogram_between(h, edges_us[i] * 1000, to_ns);
        char bar[41] = "";
        for (uint64_t k = 0; k < (40 * count + h->count - 1) / h->count; k++)
            strcat(bar, "#");
        if (count)
            say(r, "  from %6llu us %10llu %s\n", (unsigned long long)edges_us[i],
                (unsigned long long)count, bar);
    }
}

static void status_do(struct midi_server *s, struct server_client *c, char *text,
                      struct reply *r)
{
    (void)c;
    (void)text;
    say(r, "server: process %ld, %.0f s, %s, %s%s%s%s\n", (long)getpid(),
        (double)(midi_now_ns() - s->began_ns) / 1e9, s->real_time, s->sleep,
        s->awake.file >= 0 ? " (now)" : "", s->terminals,
        workers_first(s->workers) ? " (now)" : "");
    for (int i = 0; i < s->devices_count; i++) {
        const struct server_device *d = s->devices[i];
        char line[160];
        command_device_text(d, line);
        say(r,
            "device %s%s%s: in %llu (%.0f/s, %llu stray bytes), out %llu (%.0f/s, %llu "
            "refused), "
            "lost %llu, came %u times\n",
            line, d->up ? "" : ", ", d->why, (unsigned long long)d->counts.in, s->in_hz[i],
            (unsigned long long)(d->parser.counts.stray + d->parser.counts.broken),
            (unsigned long long)d->counts.out, s->out_hz[i],
            (unsigned long long)d->counts.refused, (unsigned long long)d->counts.lost,
            d->counts.opened);
    }
    for (const struct server_client *one = s->clients; one; one = one->next)
        if (one->greeted && !one->dead)
            say(r,
                "client %u %s: sent %llu, received %llu, thinned out %llu, lost %llu, %zu "
                "bytes "
                "wait%s\n",
                one->number, one->name, (unsigned long long)one->sent,
                (unsigned long long)one->received, (unsigned long long)one->thinned,
                (unsigned long long)one->lost, one->out_count,
                one->waits_for >= 0 ? ", waits for its device" : "");
    say(r, "clients: %d now, %u in all, %u dropped\n", s->clients_count, s->clients_seen,
        s->dropped);
    latency_say(&s->latency, r);
}

static const struct {
    const char *name;
    bool argument;
    void (*run)(struct midi_server *s, struct server_client *c, char *text, struct reply *r);
} commands[] = {
    {"listen", true, listen_do},    {"unlisten", true, unlisten_do},
    {"send", true, send_do},        {"silence", true, silence_do},
    {"devices", false, devices_do}, {"status", false, status_do},
};

enum { COMMANDS_COUNT = sizeof commands / sizeof *commands };

void command_do(struct midi_server *s, struct server_client *c, uint32_t number, char *text)
{
    static struct reply r; /* static, since there is one thread */
    char *rest = text;
    const char *name = strsep(&rest, " ");
    int i = 0;
    r.count = 0;
    r.text[0] = '\0';
    r.wrong = false;
    while (i < COMMANDS_COUNT && strcmp(commands[i].name, name) != 0)
        i++;
    if (i == COMMANDS_COUNT) {
        r.wrong = true;
        say(&r,
            "there is no command '%.40s'; known are listen, unlisten, send, silence, "
            "devices, status",
            name);
    } else if (commands[i].argument && (!rest || !*rest)) {
        r.wrong = true;
        say(&r, "%s needs a device's name, or *", name);
    } else {
        commands[i].run(s, c, rest, &r);
    }
    (void)client_put_text(c, r.wrong ? MIDI_WIRE_ERROR : MIDI_WIRE_REPLY, MIDI_WIRE_NO_DEVICE,
                          number, r.text);
    client_flush(c);
}
