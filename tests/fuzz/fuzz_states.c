/* fuzz_states.c - saved states that are well-formed and say what cannot be: a good one is taken apart, members of it are changed, it
 * is put together again, its checksums mended. It must be refused as a bad file, or load and then be as good as any: its past
 * can be undone, redone, changed, rendered and saved again.
 *
 *     fuzz_states [SECONDS]              seeds, always the same; or new ones for so long
 *
 * Bytes say what is changed, so libFuzzer can look for more. Most states are given to the decoder itself; every sixteenth goes through
 * a file, HDF5 and the confined reader. */
#include "../plain/state_sample.h"

#include "../sample.h"

#include <brush.h>
#include <event/event.h>
#include <techniques.h>

#include <hdf5.h>
#include <math.h>
#include <time.h>
#include <unistd.h>

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

enum { SAMPLES = 3, PIECES_MAX = 64, FIELDS_MAX = 4000, SIDE_MOST = 64, LOOKS_MOST = 60 };

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

/* ---- a run in pieces ---- */

struct piece {
    uint8_t *at;
    size_t count;
};

/* magic to air; now; names; extras; operations with their heads; notes. */
enum { PIECE_BEGIN, PIECE_NOW, PIECE_NAMES, PIECE_EXTRAS, PIECE_OPERATIONS };
enum { OPERATION_HEAD = 1 + 4 + 8 + 8 };

struct sample {
    struct piece piece[PIECES_MAX];
    int count; /* the last one is the notes */
    uint8_t *planes[PAPER_PLANES_MAX];
    int planes_count;
    /* in a file, in which nothing is deflated */
    uint8_t *file;
    size_t file_count, run_at, run_count, plane_at[PAPER_PLANES_MAX];
};

static struct sample samples[SAMPLES];
static char folder[64] = "/tmp/lutetia-states-XXXXXX", path[96];

static void piece_take(struct sample *s, const uint8_t **at, size_t count)
{
    struct piece *p = &s->piece[s->count++];
    p->count = count;
    p->at = malloc(count + 1);
    if (!p->at || s->count > PIECES_MAX)
        abort();
    memcpy(p->at, *at, count);
    *at += count;
}

static uint64_t number_at(const uint8_t *bytes, int count)
{
    struct event_reader r = {bytes, bytes + count, false};
    return event_get_number(&r, count);
}

/* Arguments as they are before they are deflated, so that their members can be changed. */
static void operation_take(struct sample *s, const uint8_t **at)
{
    size_t raw = (size_t)number_at(*at + 5, 8), stored = (size_t)number_at(*at + 13, 8);
    struct event_bytes b = {0};
    uint8_t *arguments = malloc(raw + 1);
    uLongf count = raw;
    if (!arguments)
        abort();
    if (stored == raw)
        memcpy(arguments, *at + OPERATION_HEAD, raw);
    else if (uncompress(arguments, &count, *at + OPERATION_HEAD, stored) != Z_OK)
        abort();
    event_put_bytes(&b, *at, 5);
    event_put_number(&b, raw, 8);
    event_put_number(&b, raw, 8);
    event_put_bytes(&b, arguments, raw);
    const uint8_t *whole = b.at;
    piece_take(s, &whole, b.count);
    free(arguments);
    free(b.at);
    *at += OPERATION_HEAD + stored;
}

static void run_take(struct sample *s, const uint8_t *run, size_t count)
{
    struct paper_sheet_config config;
    struct paper_air air = paper_air_default();
    struct event_bytes b = {0};
    const uint8_t *at = run;
    sample_check(paper_history_describe(run, count, &config));
    sheet_config_encode(&b, &config);
    sheet_air_encode(&b, &air);
    piece_take(s, &at, 8 + b.count);
    free(b.at);
    piece_take(s, &at, 8);
    size_t names = 1;
    for (int i = 0; i < at[0]; i++)
        names += 1 + (size_t)at[names];
    piece_take(s, &at, names);
    piece_take(s, &at, 8 + (size_t)number_at(at, 8));
    uint64_t operations = number_at(at, 4);
    at += 4;
    for (uint64_t i = 0; i < operations; i++)
        operation_take(s, &at);
    piece_take(s, &at, (size_t)(run + count - at));
}

static void run_join(const struct piece *piece, int count, struct event_bytes *out)
{
    for (int i = 0; i < count; i++) {
        if (i == PIECE_OPERATIONS)
            event_put_number(out, (uint64_t)(count - PIECE_OPERATIONS - 1), 4);
        event_put_bytes(out, piece[i].at, piece[i].count);
    }
}

/* ---- the samples ---- */

static void sheet_work(struct paper_sheet *sheet)
{
    float amounts[5 * 4];
    uint8_t gray[7 * 6];
    memset(gray, 200, sizeof gray);
    for (int i = 0; i < 5 * 4; i++)
        amounts[i] = (float)(0.1 * i);
    struct paper_screen screen = {.width_px = 7, .height_px = 6, .gray = gray};
    struct paper_place place = {&screen, 4, 3};
    struct paper_stroke_sample way[] = {{.x = 2, .y = 2, .pressure = 0.4},
                                        {.time_s = 0.1, .x = 12, .y = 8, .pressure = 0.9}};
    struct paper_brush brush = paper_brush_default();
    brush.bristles = 7;
    brush.width = brush.depth = 3;
    sample_check(paper_sheet_brush(sheet, &brush));
    sample_check(paper_sheet_dip(
        sheet, &(struct paper_dip){.part = 1, .side = {-1, 1}, .amount = {1, 0.5, 0.2}}));
    sample_check(paper_sheet_stroke(
        sheet, &(struct paper_stroke){.pace = 20, .samples_count = 2, .samples = way}, NULL));
    sample_check(paper_sheet_resist(sheet, &screen, -2, 1, true));
    sample_check(paper_sheet_wash(
        sheet, &(struct paper_wash){
                   .place = place, .to = {9, 9}, .amount = {1, 0.5}, .end = {0.5, 0, 1}}));
    sample_check(paper_sheet_salt(sheet, &(struct paper_salt){.x = 8,
                                                              .y = 6,
                                                              .radius = 4,
                                                              .grains = 3,
                                                              .size = {1, 2},
                                                              .strength = 1,
                                                              .reach = 5}));
    sample_check(paper_sheet_step(sheet));
    sample_check(paper_sheet_print(
        sheet, &(struct paper_print){1, 1, 5, 4, .amount = {amounts, NULL, amounts}}));
    sample_check(paper_sheet_lift(sheet, &(struct paper_lift){.place = place, .part = 0.5}));
    sample_check(
        paper_sheet_varnish(sheet, &(struct paper_varnish){.place = place, .amount = 0.7}));
    sample_check(paper_sheet_splatter(
        sheet,
        &(struct paper_splatter){
            .x = 8, .y = 6, .radius = 5, .drops = 3, .size = {0.5, 1}, .amount = {1, 0.3}}));
    sample_check(paper_sheet_dry(sheet));
    sample_check(paper_sheet_seal(sheet));
}

static struct paper_sheet *sheet_made(int which)
{
    struct paper_sheet_config config =
        sheet_of_two(SAMPLE_WIDTH, SAMPLE_HEIGHT, "burnt umber", "phthalo green");
    struct paper_sheet *sheet;
    struct paper_air air = paper_air_default();
    config.seed = (uint64_t)which + 1;
    if (which == 2)
        config.parts = 0; /* the thesis's paper */
    sample_check(paper_sheet_create(&config, &sheet));
    sample_check(paper_history_begin(sheet, 1e6));
    air.humidity = 0.01;
    sample_check(paper_sheet_air(sheet, &air));
    sample_paint(sheet, 2);
    sample_check(paper_sheet_blot(sheet, NULL, 0, 0, 0.5, 0));
    if (which < 2)
        sheet_work(sheet);
    if (which > 0) {
        paper_history_undo(sheet, 2);
        sample_check(paper_history_insert_begin(sheet, 2));
        sample_check(paper_sheet_put(sheet, NULL, 0, 0, (double[]){0.5, 0.1, 0.1}));
        sample_check(paper_history_insert_end(sheet, true));
    }
    return sheet;
}

/* The planes without filters and in a piece, the run without deflated arguments: where they are in the file is where they can be
 * changed. */
static void file_make(struct sample *s, const struct paper_plane *planes)
{
    const hsize_t size[2] = {SAMPLE_HEIGHT, SAMPLE_WIDTH};
    struct event_bytes run = {0};
    run_join(s->piece, s->count, &run);
    s->run_count = run.count;
    hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    hid_t space = H5Screate_simple(2, size, NULL), how = H5Pcreate(H5P_DATASET_CREATE);
    hid_t group = H5Gopen2(file, "sheet-1/planes", H5P_DEFAULT);
    H5Pset_chunk(how, 2, size);
    for (int i = 0; i < s->planes_count; i++) {
        haddr_t at;
        hsize_t bytes;
        unsigned mask;
        H5Ldelete(group, planes[i].name, H5P_DEFAULT);
        hid_t set =
            H5Dcreate2(group, planes[i].name, planes[i].whole ? H5T_STD_U32LE : H5T_IEEE_F32LE,
                       space, H5P_DEFAULT, how, H5P_DEFAULT);
        H5Dwrite(set, planes[i].whole ? H5T_NATIVE_UINT32 : H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL,
                 H5P_DEFAULT, s->planes[i]);
        H5Fflush(file, H5F_SCOPE_GLOBAL);
        if (H5Dget_chunk_info_by_coord(set, (const hsize_t[]){0, 0}, &mask, &at, &bytes) < 0)
            abort();
        s->plane_at[i] = (size_t)at;
        H5Dclose(set);
    }
    hsize_t length = run.count;
    hid_t line = H5Screate_simple(1, &length, NULL);
    H5Ldelete(file, "sheet-1/run", H5P_DEFAULT);
    hid_t set = H5Dcreate2(file, "sheet-1/run", H5T_STD_U8LE, line, H5P_DEFAULT, H5P_DEFAULT,
                           H5P_DEFAULT);
    H5Dwrite(set, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, run.at);
    s->run_at = (size_t)H5Dget_offset(set);
    H5Dclose(set);
    H5Sclose(line);
    H5Gclose(group);
    H5Pclose(how);
    H5Sclose(space);
    H5Fclose(file);
    s->file = sample_file_read(path, &s->file_count);
    for (int i = 0; i < s->planes_count; i++) /* addresses may be from the userblock's end */
        if (s->plane_at[i] + 4 * SAMPLE_WIDTH * SAMPLE_HEIGHT > s->file_count ||
            memcmp(s->file + s->plane_at[i], s->planes[i], 4 * SAMPLE_WIDTH * SAMPLE_HEIGHT) !=
                0)
            s->plane_at[i] += SAMPLE_HEADER;
    const uint8_t *found = memmem(s->file, s->file_count, run.at, run.count);
    if (!found)
        abort();
    s->run_at = (size_t)(found - s->file);
    free(run.at);
}

static void sample_make(struct sample *s, int which)
{
    struct paper_sheet *sheet = sheet_made(which);
    struct paper_plane planes[PAPER_PLANES_MAX];
    uint8_t *run;
    size_t count;
    sample_check(paper_history_encode(sheet, &run, &count));
    run_take(s, run, count);
    free(run);
    s->planes_count = paper_sheet_planes(sheet, planes);
    for (int i = 0; i < s->planes_count; i++) {
        s->planes[i] = calloc(4, SAMPLE_WIDTH * SAMPLE_HEIGHT);
        sample_check(paper_sheet_plane_read(sheet, i, s->planes[i]));
    }
    sample_check(paper_state_save(path, &(struct paper_state_sheet){1, sheet}, 1));
    paper_sheet_destroy(sheet);
    file_make(s, planes);
}

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
        sample_make(&samples[i], i);
    return 0;
}

/* ---- changes ---- */

/* A number in a piece: where members are, mostly from the beginning, now and then anywhere. */
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

/* Its length changes, and where it says how long it is, mostly that, too. */
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

/* Changes the pieces, whose bytes are copies of its own; returns how many there are then. */
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

/* How often something that takes long may ask before it is stopped. */
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

/* It is as it should be, or was stopped because it took long. */
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
    const struct sample *sample;
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

static void loaded(struct choices *c, const struct sample *s, const uint8_t *const *words,
                   const struct event_bytes *run)
{
    struct paper_sheet_config config;
    struct paper_sheet *sheet;
    enum paper_status status = paper_history_describe(run->at, run->count, &config);
    if (status == PAPER_OK && (config.width > SIDE_MOST || config.height > SIDE_MOST))
        return; /* whoever loads it sees whether there is memory for it */
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

/* The same through a file. */
static void loaded_from_file(const struct sample *s, const uint8_t *const *words,
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
    const struct sample *s = &samples[choose(&c, SAMPLES)];
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
    run_join(piece, pieces, &run);
    if (file == 0)
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
/* Prints how many were looked at. */
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
        return 1; /* it looks at half of what it should */
    return 0;
}
#endif
