/* fuzz_scripts.c - runs random scripts by the library. Each ends, with one line where it fails,
 * and does the process no harm.
 *
 *     fuzz_scripts                     SEEDS scripts, the same in every run
 *     fuzz_scripts FIRST COUNT         scripts from seed FIRST on; prints which one runs
 *     fuzz_scripts --seconds S FIRST   as many as there is time for
 *     fuzz_scripts --show SEED         prints one
 *     fuzz_scripts FILE...             inputs that libFuzzer found
 *
 * Some scripts are trusted, some have finalizers, and some are stopped by the host, the clock
 * or a lack of memory. */
#include "script_grammar.h"

#include <script.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "../display/scratch.h"

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

/* The host's behaviour, and the calls that it got. */
struct meeting {
    long asked, stops_after; /* calls of interrupted(); 0: never */
    long steps, fails_after;
    int lines;
    struct script_source source;
};

static bool interrupted(void *context)
{
    struct meeting *m = context;
    return m->stops_after > 0 && ++m->asked > m->stops_after;
}

static void error(void *context, const char *text)
{
    struct meeting *m = context;
    for (const char *c = text; *c; c++)
        if ((unsigned char)*c < ' ')
            abort();
    m->lines++;
}

static const char *step(void *context, int paper, struct paper_sheet *sheet)
{
    struct meeting *m = context;
    (void)paper;
    if (paper_sheet_get_config(sheet)->width < 1)
        abort();
    return m->fails_after > 0 && ++m->steps > m->fails_after ? "the host has enough" : NULL;
}

static void progress(void *context, const struct script_progress *p)
{
    (void)context;
    if (p && p->done > p->total)
        abort();
}

static void overdue(void *context)
{
    (void)context;
    fputs("a script did not end\n", stderr);
    abort();
}

static enum script_status finish(void *context, const struct paper_state_sheet *papers,
                                 int count, enum script_status status)
{
    (void)context;
    for (int i = 0; i < count; i++)
        if (paper_sheet_get_config(papers[i].sheet)->width < 1 ||
            (i > 0 && papers[i].number <= papers[i - 1].number))
            abort();
    return status;
}

static char script[512];

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    (void)argc;
    (void)argv;
    const char *lacking = script_grammar_lacks();
    if (lacking) {
        fprintf(stderr, "script_grammar.c has no row for %s\n", lacking);
        exit(1);
    }
    snprintf(script, sizeof script, "%s", scratch_path("fuzz.lua"));
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    static struct meeting m;
    m = (struct meeting){.source = {.at = bytes, .end = bytes + count}};
    unsigned kind = script_byte(&m.source);
    m.source.trusted = kind % 4 == 0;
    if (kind % 8 == 1)
        m.stops_after = 1 + script_byte(&m.source) * 4;
    if (kind % 8 == 3)
        m.fails_after = 1 + script_byte(&m.source) % 8;
    struct script_config config = script_config_default(script);
    config.in_folder = config.out_folder = scratch_dir;
    config.trusted = m.source.trusted;
    config.timeout_s = kind % 8 == 5 ? 0.02 : 20;
    config.grace_s = 20;
    config.memory_bytes = (size_t)(kind % 8 == 7 ? 200 + 8 * script_byte(&m.source) : 48 << 10)
                          << 10;
    config.papers_max = kind % 16 == 2 ? 3 : 0;
    const char *text = script_by_chance(&m.source);
    FILE *file = fopen(script, "wb");
    if (!file || fputs(text, file) < 0 || fclose(file) != 0)
        abort();
    const struct script_host host = {.context = &m,
                                     .error = error,
                                     .interrupted = interrupted,
                                     .progress = progress,
                                     .step = step,
                                     .finish = finish,
                                     .overdue = overdue};
    enum script_status status = script_run(&config, &host);
    if ((m.lines == 1) != (status != SCRIPT_OK) || m.lines > 1)
        abort();
    return 0;
}

#ifndef LUTETIA_FUZZ_LIBFUZZER
#include "../sample.h"

enum { SEEDS = 35, BYTES = 500 };

static void bytes_make(uint64_t seed, uint8_t bytes[BYTES])
{
    uint64_t state = sample_mixed(seed); /* mixed, because sample_word() adds a constant */
    for (int i = 0; i < BYTES; i++)
        bytes[i] = (uint8_t)(sample_word(&state) >> 24);
}

static int show(uint64_t seed)
{
    static struct script_source source;
    uint8_t bytes[BYTES];
    bytes_make(seed, bytes);
    source = (struct script_source){
        .at = bytes + 1, .end = bytes + BYTES, .trusted = bytes[0] % 4 == 0};
    if (bytes[0] % 8 == 1 || bytes[0] % 8 == 3 || bytes[0] % 8 == 7)
        script_byte(&source);
    printf("-- kind %d%s\n%s", bytes[0] % 16, source.trusted ? ", trusted" : "",
           script_by_chance(&source));
    return 0;
}

static int file_run(const char *name)
{
    static uint8_t bytes[1 << 20];
    FILE *file = fopen(name, "rb");
    if (!file) {
        perror(name);
        return 1;
    }
    size_t count = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    LLVMFuzzerTestOneInput(bytes, count);
    return 0;
}

int main(int argc, char **argv)
{
    uint64_t first = 1, count = SEEDS;
    time_t until = 0;
    bool said = true;
    LLVMFuzzerInitialize(NULL, NULL);
    if (argc == 3 && strcmp(argv[1], "--show") == 0)
        return show(strtoull(argv[2], NULL, 10));
    if (argc == 4 && strcmp(argv[1], "--seconds") == 0) {
        until = time(NULL) + atol(argv[2]);
        first = strtoull(argv[3], NULL, 10);
        count = UINT64_MAX;
    } else if (argc == 3 && strspn(argv[1], "0123456789") == strlen(argv[1])) {
        first = strtoull(argv[1], NULL, 10);
        count = strtoull(argv[2], NULL, 10);
    } else if (argc > 1) {
        for (int i = 1; i < argc; i++)
            if (file_run(argv[i]))
                return 1;
        return 0;
    } else {
        said = false;
    }
    uint64_t done = 0;
    for (; done < count && (!until || time(NULL) < until); done++) {
        uint8_t bytes[BYTES];
        if (said)
            fprintf(stderr, "seed %llu\n", (unsigned long long)(first + done));
        bytes_make(first + done, bytes);
        LLVMFuzzerTestOneInput(bytes, BYTES);
    }
    printf("%llu scripts\n", (unsigned long long)done);
    return 0;
}
#endif
