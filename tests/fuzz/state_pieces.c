/* state_pieces.c - see state_pieces.h. */
#include "state_pieces.h"

#include "../plain/state_sample.h"

#include <brush.h>
#include <techniques.h>

#include <hdf5.h>

static void piece_take(struct state_pieces *s, const uint8_t **at, size_t count)
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

/* Takes an operation with its arguments inflated, so that their members can be changed. */
static void operation_take(struct state_pieces *s, const uint8_t **at)
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

static void run_take(struct state_pieces *s, const uint8_t *run, size_t count)
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

void state_pieces_join(const struct piece *piece, int count, struct event_bytes *out)
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
    config.deckled = which == 1;
    config.deckle = (struct paper_deckle){.margin = 2, .waves = 1, .thin = 2, .fringe = 1};
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

/* Writes a file whose planes are contiguous and without filters, and whose run has no deflated
 * arguments, so that their bytes can be changed in the file. */
static void file_make(struct state_pieces *s, const struct paper_plane *planes,
                      const char *path)
{
    const hsize_t size[2] = {SAMPLE_HEIGHT, SAMPLE_WIDTH};
    struct event_bytes run = {0};
    state_pieces_join(s->piece, s->count, &run);
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
    for (int i = 0; i < s->planes_count; i++) /* addresses may count from the userblock's end */
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

void state_pieces_make(struct state_pieces *s, int which, const char *path)
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
    file_make(s, planes, path);
}
