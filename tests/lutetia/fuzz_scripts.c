/* fuzz_scripts.c - scripts by chance: calls of the library with whatever arguments, in whatever order.
 *
 * Each script must end: with status 0, or with 1 and one line. With libFuzzer, bytes choose the words. */
#include "../../host/lutetia/lutetia.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "../display/scratch.h"

enum { TEXT_MAX = 8192, STATEMENTS_MAX = 24 };

struct source {
    const uint8_t *at, *end;
    char text[TEXT_MAX];
    size_t length;
};

static unsigned byte(struct source *s)
{
    return s->at < s->end ? *s->at++ : 0;
}

static void say(struct source *s, const char *text)
{
    size_t count = strlen(text);
    if (s->length + count + 1 < sizeof s->text) {
        memcpy(s->text + s->length, text, count + 1);
        s->length += count;
    }
}

#define ONE_OF(s, list) ((list)[byte(s) % (sizeof(list) / sizeof *(list))])

static void value(struct source *s, int depth);

static void number(struct source *s)
{
    static const char *const numbers[] = {
        "0",          "1",     "-1",     "0.5",    "2",    "7",     "8",       "9.75",
        "12",         "-0.0",  "0/0",    "1/0",    "-1/0", "1e300", "1 << 62", "16384",
        "0x7fffffff", "-2^31", "1e-300", "100000", "3.3",  "20"};
    say(s, ONE_OF(s, numbers));
}

static void mask(struct source *s, int depth)
{
    static const char *const makers[] = {"rect", "ellipse", "polygon", "line",
                                         "text", "mask",    "image"};
    static const char *const methods[] = {":move", ":rotate", ":scale", ":soften", ":bounds"};
    unsigned kind = byte(s);
    if (kind < 120 || depth > 2) { /* most are good ones */
        static const char *const good[] = {"rect(1, 2, 5, 4)",
                                           "ellipse(5, 5, 3.5, 2)",
                                           "polygon{{1, 1}, {9, 2}, {4, 8}}",
                                           "M",
                                           "line({{1, 1, 3}, {8, 7, 0}})",
                                           "text('a', {size = 9})"};
        say(s, ONE_OF(s, good));
    } else if (kind < 180) {
        say(s, ONE_OF(s, makers));
        say(s, "(");
        for (unsigned i = 0, count = byte(s) % 5; i < count; i++) {
            say(s, i ? ", " : "");
            value(s, depth + 1);
        }
        say(s, ")");
    } else if (kind < 220) {
        static const char *const operators[] = {" + ", " * ", " - ", " .. ", " < "};
        say(s, "(");
        mask(s, depth + 1);
        say(s, ONE_OF(s, operators));
        mask(s, depth + 1);
        say(s, ")");
    } else {
        say(s, "(");
        mask(s, depth + 1);
        say(s, ")");
        say(s, ONE_OF(s, methods));
        say(s, "(");
        value(s, depth + 1);
        say(s, ", ");
        value(s, depth + 1);
        say(s, ")");
    }
}

static void table(struct source *s, int depth)
{
    static const char *const keys[] = {
        "water",    "cyan",     "size",  "font",   "x",       "y",      "align",   "show",
        "layer",    "low",      "high",  "bits",   "gravity", "spread", "tension", "film",
        "humidity", "edge",     "width", "height", "stock",   "weight", "white",   "black",
        "K",        "like",     "bogus", "radius", "drops",   "grains", "seed",    "points",
        "path",     "pressure", "from",  "to",     "into",    "mask",   "seconds"};
    say(s, "{");
    for (unsigned i = 0, count = byte(s) % 4; i < count; i++) {
        say(s, i ? ", " : "");
        if (byte(s) % 4) {
            say(s, ONE_OF(s, keys));
            say(s, " = ");
        }
        value(s, depth + 1);
    }
    say(s, "}");
}

static void value(struct source *s, int depth)
{
    static const char *const words[] = {"nil",
                                        "true",
                                        "'water'",
                                        "'cyan'",
                                        "'height'",
                                        "'../x.png'",
                                        "'a.png'",
                                        "'surface pigment'",
                                        "''",
                                        "'\\0'",
                                        "print",
                                        "function(x, y) return x end",
                                        "function() error({}) end",
                                        "p",
                                        "p.width",
                                        "p.mask",
                                        "paper",
                                        "coroutine.wrap(print)",
                                        "B",
                                        "{{1, 2}, {8, 7}}",
                                        "{0.2, 0.9}",
                                        "'M1 1Q5 5 9 2z'",
                                        "{brush = B, pace = 0, points = {{2, 3}, {7, 5, 1}}}",
                                        "picture(3, 2, function() return 1, 0, 0.5 end)",
                                        "setmetatable({}, {__index = error})",
                                        "string.rep('x', 3000)"};
    unsigned kind = byte(s) % 16;
    if (depth > 3 || kind < 7)
        number(s);
    else if (kind < 9)
        mask(s, depth + 1);
    else if (kind < 12)
        table(s, depth + 1);
    else
        say(s, ONE_OF(s, words));
}

static void statement(struct source *s)
{
    static const char *const methods[] = {
        "put",  "wash", "blot",    "resist",   "unresist", "dry",    "seal",     "layer",
        "mask", "at",   "total",   "air",      "frame",    "close",  "step",     "wash",
        "lift", "salt", "varnish", "splatter", "brush",    "stroke", "separate", "picture",
        "undo", "redo", "to",      "moments",  "save",     "film",   "type"};
    unsigned kind = byte(s) % 10;
    say(s, "pcall(function() ");
    if (kind < 2) {
        say(s, "M = ");
        mask(s, 0);
    } else if (kind == 8) { /* the paper waits: a step is many kernels */
        static const char *const ways[] = {
            "points = ", "path = ", "way = ", "file = ", "svg = "};
        say(s, "p:stroke{brush = B, pace = 0, ");
        say(s, ONE_OF(s, ways));
        value(s, 1);
        say(s, ", pressure = ");
        value(s, 1);
        say(s, "}");
    } else if (kind == 9) {
        static const char *const calls[] = {"B:dip(",
                                            "B:rinse(",
                                            "B:wipe(",
                                            "B:holds(",
                                            "path(",
                                            "svg(",
                                            "p:brush{number = 1, width = "};
        unsigned call = byte(s) % 7;
        say(s, calls[call]);
        value(s, 0);
        say(s, call == 6 ? "}" : ")");
    } else {
        const char *method = ONE_OF(s, methods);
        say(s, "p:");
        say(s, method);
        say(s, "(");
        if (strcmp(method, "step") == 0) { /* kernels take long to compile: no time */
            say(s, "0)");
        } else {
            for (unsigned i = 0, count = byte(s) % 5; i < count; i++) {
                say(s, i ? ", " : "");
                if (i == 0 && byte(s) % 2)
                    mask(s, 0);
                else
                    value(s, 0);
            }
            say(s, ")");
        }
    }
    say(s, " end)\n");
}

static char script[512];

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    (void)argc;
    (void)argv;
    snprintf(script, sizeof script, "%s", scratch_path("fuzz.lua"));
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    static struct source s;
    s = (struct source){.at = bytes, .end = bytes + count};
    say(&s,
        "local M = rect(1, 1, 3, 3)\n"
        "local p = paper{width = 12, height = 10, pigments = {'cyan'}, model = {'infused'}}\n"
        "local B = p:brush{width = 3, bristles = 8}\n");
    for (int i = 0; i < STATEMENTS_MAX && s.at < s.end; i++)
        statement(&s);
    FILE *file = fopen(script, "wb");
    if (!file || fwrite(s.text, 1, s.length, file) != s.length || fclose(file) != 0)
        abort();
    char *arguments[] = {(char[]){"run"}, script,
                         (char[]){"-q"},  (char[]){"-o"},
                         scratch_dir,     (char[]){"--memory"},
                         (char[]){"64"},  (char[]){"--timeout"},
                         (char[]){"60"},  NULL};
    int status = verb_run(9, arguments);
    if (status != 0 && status != 1)
        abort();
    return 0;
}

#ifndef LUTETIA_FUZZ_LIBFUZZER
#include "../sample.h"

/* Seeds, always the same. */
int main(void)
{
    enum { SCRIPTS = 150, BYTES = 400 };
    uint8_t bytes[BYTES];
    uint64_t state = 11;
    LLVMFuzzerInitialize(NULL, NULL);
    if (!freopen("/dev/null", "w", stderr))
        return 1;
    for (int i = 0; i < SCRIPTS; i++) {
        for (int j = 0; j < BYTES; j++)
            bytes[j] = (uint8_t)sample_word(&state);
        LLVMFuzzerTestOneInput(bytes, BYTES);
    }
    return 0;
}
#endif
