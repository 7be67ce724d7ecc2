/* fuzz_states.c - forges well-formed saved states with impossible contents. It takes a good
 * state apart, changes members, puts it together again and corrects its checksums. The state
 * must be refused as a bad file, or load and then work like any other: its history can be
 * undone, redone, changed, rendered and saved again.
 *
 *     fuzz_states [SECONDS]              fixed seeds; or new ones for that long
 *
 * Bytes choose the changes, so that libFuzzer can search, too. Most states go straight to the
 * decoder; every sixteenth goes through a file, HDF5 and the confined reader. (security.md 7,
 * 10) */
#include "state_pieces.h"

#include "../plain/state_sample.h"

#include "../sample.h"

#include <math.h>
#include <time.h>
#include <unistd.h>

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

enum { SAMPLES = 3, SIDE_MOST = 64, LOOKS_MOST = 60 };

/* ---- what bytes choose ---- */

struct choices {
    const uint8_t *at, *end;
};

static uint32_t choose(struct choices *c, uint32_t limit)
{
    uint32_t number = 0;
    for (uint32_t most = limit; most > 1 && c->at < c->end; most = (most + 255) / 256)
        number = number << 8 | *c->at++;
    return limit ? number % limit : 0;
}

static uint64_t number_by_choice(struct choices *c)
{
    static const double doubles[] = {0,      -0.0,   1,      -1,      0.5,   1e-320,   1e308,
                                     -1e308, 0x1p24, 0x1p31, 4,       1e-9,  INFINITY, NAN,
                                     100,    0x1p45, 0x1p46, 0x1p-10, 16384, -0.5};
    static const int64_t wholes[] = {
        0,     1,     -1,    2,         7,         8,          255,     256,       512,
        65535, 16384, 16385, INT32_MAX, INT32_MIN, UINT32_MAX, 1 << 24, INT64_MAX, INT64_MIN};
    uint32_t kind = choose(c, 4), which = choose(c, 256);
    uint64_t bits = 0;
    if (kind < 2)
        memcpy(&bits, &doubles[which % (sizeof doubles / sizeof *doubles)], sizeof bits);
    else if (kind == 2)
        bits = (uint64_t)wholes[which % (sizeof wholes / sizeof *wholes)];
    else
        for (int i = 0; i < 8; i++)
            bits = bits << 8 | choose(c, 256);
    return bits;
}

static struct state_pieces samples[SAMPLES];
static char folder[64] = "/tmp/lutetia-states-XXXXXX", path[96];

static void folder_remove(void)
{
    unlink(path);
    rmdir(folder);
}

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    (void)argc;
    (void)argv;
    if (!mkdtemp(folder))
        abort();
    atexit(folder_remove);
    snprintf(path, sizeof path, "%s/state.h5", folder);
    for (int i = 0; i < SAMPLES; i++)
        state_pieces_make(&samples[i], i, path);
    return 0;
}

/* ---- changes ---- */

/* Changes a number in a piece: mostly near its beginning, where members are, sometimes
 * anywhere. */
static void number_change(struct choices *c, struct piece *p)
{
    static const uint8_t sizes[] = {8, 8, 4, 1};
    size_t size = sizes[choose(c, 4)];
    uint64_t bits = number_by_choice(c);
    if (p->count < size)
        return;
    size_t near = p->count - size + 1;
    if (choose(c, 4) && near > 400)
        near = 400;
    memcpy(p->at + choose(c, (uint32_t)near), &bits, size);
}

/* Changes a piece's length, and mostly also the number in it that gives its length. */
static void length_change(struct choices *c, struct piece *p, int kind)
{
    size_t cut = choose(c, 64);
    if (cut >= p->count)
        return;
    p->count -= cut;
    if (!choose(c, 4))
        return;
    uint64_t rest = p->count - (kind == PIECE_EXTRAS ? 8 : OPERATION_HEAD);
    if (kind == PIECE_EXTRAS && p->count >= 8)
        memcpy(p->at, &rest, 8);
    if (kind >= PIECE_OPERATIONS && p->count >= OPERATION_HEAD) {
        memcpy(p->at + 5, &rest, 8);
        memcpy(p->at + 13, &rest, 8);
    }
}

/* Changes the pieces, whose bytes are copies; returns their new number. */
static int pieces_change(struct choices *c, struct piece *piece, int count)
{
    int which = (int)choose(c, (uint32_t)count);
    int operations = count - PIECE_OPERATIONS - 1;
    switch (choose(c, 10)) {
    case 0:
        length_change(c, &piece[which], which < count - 1 ? which : -1);
        break;
    case 1: /* an operation is gone */
        if (operations > 0) {
            int gone = PIECE_OPERATIONS + (int)choose(c, (uint32_t)operations);
            free(piece[gone].at);
            memmove(&piece[gone], &piece[gone + 1], (size_t)(count - gone - 1) * sizeof *piece);
            count--;
        }
        break;
    case 2: /* two in the other's place */
        if (operations > 1) {
            int one = PIECE_OPERATIONS + (int)choose(c, (uint32_t)operations - 1);
            struct piece other = piece[one];
            piece[one] = piece[one + 1];
            piece[one + 1] = other;
        }
        break;
    case 3: /* arguments of another kind */
        if (operations > 0)
            piece[PIECE_OPERATIONS + (int)choose(c, (uint32_t)operations)].at[0] =
                (uint8_t)choose(c, SHEET_EVENT_KINDS + 1);
        break;
    default:
        number_change(c, &piece[which]);
    }
    return count;
}

/* ---- a state that has loaded ---- */

static long loaded_count;

/* The calls of watch() that are left before it stops a long computation. */
static int looks;

static bool watch(void *context, long done, long total)
{
    (void)context;
    (void)done;
    (void)total;
    return looks-- > 0;
}

static bool due(void *context)
{
    (void)context;
    return looks-- <= 0;
}

static void wrong(const char *what, enum paper_status status)
{
    fprintf(stderr, "%s: status %d: %s\n", what, (int)status, paper_error());
    abort();
}

/* Aborts unless status is OK, or the work was stopped because it took long. */
static void fine(const char *what, enum paper_status status)
{
    bool stopped = status == PAPER_MACHINE_FAILED && strcmp(paper_error(), "stopped") == 0;
    if (status != PAPER_OK && status != PAPER_NO_MEMORY && !stopped)
        wrong(what, status);
    looks = LOOKS_MOST;
}

static void saved_again(struct paper_sheet *sheet)
{
    uint8_t *run;
    size_t count;
    struct paper_sheet_config config;
    enum paper_status status = paper_history_encode(sheet, &run, &count);
    fine("encoded", status);
    if (status == PAPER_OK && paper_history_describe(run, count, &config) != PAPER_OK)
        wrong("described again", PAPER_BAD_FILE);
    free(run);
}

static void use(struct choices *c, struct paper_sheet *sheet)
{
    double total;
    struct paper_sheet *other = NULL;
    static uint16_t rgb[3 * SIDE_MOST * SIDE_MOST];
    struct paper_sheet_view view = {.show = PAPER_SHOW_WET, .high = 1};
    looks = LOOKS_MOST;
    paper_history_set_watch(sheet, watch, NULL);
    paper_sheet_stop_when(sheet, due, NULL);
    if (choose(c, 2))
        fine("viewed", paper_sheet_view(sheet, &view, rgb));
    if (choose(c, 2))
        fine("stepped", paper_sheet_step(sheet));
    if (choose(c, 2)) {
        paper_history_undo(sheet, 1 + (int)choose(c, 12));
        fine("undone", paper_sheet_total(sheet, 0, &total));
    }
    if (choose(c, 2)) {
        enum paper_status status = paper_history_seek(sheet, (long)choose(c, 12));
        if (status != PAPER_BAD_ARGUMENT)
            fine("sought", status);
        fine("looked at", paper_sheet_total(sheet, 1, &total));
    }
    if (choose(c, 2)) {
        paper_history_redo(sheet, (int)choose(c, 40));
        fine("redone", paper_sheet_view(sheet, &view, rgb));
    }
    if (choose(c, 4) == 0) {
        enum paper_status status =
            paper_history_render(sheet, 0.5 + choose(c, 3) * 0.75, 1, -1, &other);
        if (status != PAPER_BAD_ARGUMENT)
            fine("rendered", status);
        paper_sheet_destroy(other);
    }
    saved_again(sheet);
}

struct planes {
    const struct state_pieces *sample;
    const uint8_t *const *words;
    size_t bytes; /* that the sheet asks for */
};

static enum paper_status plane_give(void *context, int number, void *words)
{
    const struct planes *from = context;
    size_t have = 4 * SAMPLE_WIDTH * SAMPLE_HEIGHT;
    memset(words, 0, from->bytes);
    if (number < from->sample->planes_count)
        memcpy(words, from->words[number], from->bytes < have ? from->bytes : have);
    return PAPER_OK;
}

static void loaded(struct choices *c, const struct state_pieces *s, const uint8_t *const *words,
                   const struct event_bytes *run)
{
    struct paper_sheet_config config;
    struct paper_sheet *sheet;
    enum paper_status status = paper_history_describe(run->at, run->count, &config);
    if (status == PAPER_OK && (config.width > SIDE_MOST || config.height > SIDE_MOST))
        return; /* a large sheet is not an error: loading it would check memory */
    if (status == PAPER_OK) {
        struct planes from = {s, words, 4 * (size_t)config.width * (size_t)config.height};
        status = paper_history_decode(run->at, run->count, choose(c, 2), choose(c, 2) ? 1e6 : 0,
                                      plane_give, &from, &sheet);
    }
    if (status == PAPER_OK) {
        loaded_count++;
        use(c, sheet);
        paper_sheet_destroy(sheet);
    } else if (status != PAPER_BAD_FILE && status != PAPER_NO_MEMORY) {
        wrong("decoded", status);
    }
}

/* Loads a changed state from a file. */
static void loaded_from_file(const struct state_pieces *s, const uint8_t *const *words,
                             const struct event_bytes *run)
{
    if (run->count != s->run_count)
        return;
    uint8_t *file = malloc(s->file_count);
    if (!file)
        abort();
    memcpy(file, s->file, s->file_count);
    memcpy(file + s->run_at, run->at, run->count);
    for (int i = 0; i < s->planes_count; i++)
        memcpy(file + s->plane_at[i], words[i], 4 * SAMPLE_WIDTH * SAMPLE_HEIGHT);
    sample_header_mend(file, s->file_count);
    sample_file_write(path, file, s->file_count);
    free(file);
    struct paper_state *state;
    struct paper_sheet_config config;
    sample_check(paper_state_open(path, &state));
    enum paper_status status = paper_state_describe(state, 0, &config);
    struct paper_sheet *sheet = NULL;
    if (status == PAPER_OK && config.width <= SIDE_MOST && config.height <= SIDE_MOST)
        status = paper_state_load(state, 0, false, 0, &sheet);
    if (status != PAPER_OK && status != PAPER_BAD_FILE && status != PAPER_NO_MEMORY)
        wrong("read", status);
    paper_sheet_destroy(sheet);
    paper_state_close(state);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    struct choices c = {bytes, bytes + count};
    const struct state_pieces *s = &samples[choose(&c, SAMPLES)];
    struct piece piece[PIECES_MAX];
    uint8_t *words[PAPER_PLANES_MAX];
    const uint8_t *given[PAPER_PLANES_MAX];
    int pieces = s->count, changes = 1 + (int)choose(&c, 3), file = (int)choose(&c, 16);
    for (int i = 0; i < pieces; i++) {
        piece[i] = (struct piece){malloc(s->piece[i].count + 1), s->piece[i].count};
        memcpy(piece[i].at, s->piece[i].at, piece[i].count);
    }
    for (int i = 0; i < s->planes_count; i++) {
        given[i] = words[i] = malloc(4 * SAMPLE_WIDTH * SAMPLE_HEIGHT);
        memcpy(words[i], s->planes[i], 4 * SAMPLE_WIDTH * SAMPLE_HEIGHT);
    }
    for (int i = 0; i < changes; i++)
        if (choose(&c, 5)) {
            pieces = pieces_change(&c, piece, pieces);
        } else {
            uint64_t bits = number_by_choice(&c);
            double number;
            memcpy(&number, &bits, sizeof number);
            float single = (float)number;
            memcpy(words[choose(&c, (uint32_t)s->planes_count)] +
                       4 * choose(&c, SAMPLE_WIDTH * SAMPLE_HEIGHT),
                   &single, sizeof single);
        }
    struct event_bytes run = {0};
    state_pieces_join(piece, pieces, &run);
    if (file == 15)
        loaded_from_file(s, given, &run);
    loaded(&c, s, given, &run);
    free(run.at);
    for (int i = 0; i < pieces; i++)
        free(piece[i].at);
    for (int i = 0; i < s->planes_count; i++)
        free(words[i]);
    return 0;
}

#ifndef LUTETIA_FUZZ_LIBFUZZER
/* Prints how many states were tried. */
int main(int argc, char **argv)
{
    enum { STATES = 1200 };
    double seconds = argc > 1 ? atof(argv[1]) : 0;
    time_t began = time(NULL);
    uint64_t state = argc > 1 ? (uint64_t)began : 12;
    uint8_t bytes[96] = {0};
    long count = 0;
    LLVMFuzzerInitialize(NULL, NULL);
    for (; seconds > 0 ? difftime(time(NULL), began) < seconds : count < STATES; count++) {
        for (size_t i = 0; i < sizeof bytes; i++)
            bytes[i] = (uint8_t)sample_word(&state);
        LLVMFuzzerTestOneInput(bytes, sizeof bytes);
    }
    printf("%ld states, of which %ld loaded\n", count, loaded_count);
    if (loaded_count < count / 20 || loaded_count > count - count / 20)
        return 1; /* too few were loaded, or refused */
    return 0;
}
#endif
