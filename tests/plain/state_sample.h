/* state_sample.h - small sheets with a history, and changed files of states whose headers agree
 * with them. */
#ifndef LUTETIA_TESTS_STATE_SAMPLE_H
#define LUTETIA_TESTS_STATE_SAMPLE_H

#include <drawing.h>
#include <paper.h>
#include <state.h>

#include "../sheets.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <zlib.h>

enum { SAMPLE_WIDTH = 16, SAMPLE_HEIGHT = 12, SAMPLE_HEADER = 512 };

static inline void sample_check(enum paper_status status)
{
    if (status == PAPER_OK)
        return;
    fprintf(stderr, "status %d: %s\n", (int)status, paper_error());
    abort();
}

/* Puts a screen on the sheet and runs `steps` steps. */
static inline void sample_turn(struct paper_sheet *sheet, int turn, int steps)
{
    uint8_t gray[5 * 4];
    memset(gray, 255 - 20 * turn, sizeof gray);
    struct event_bytes drawn = {0}; /* every other screen says what it was drawn from */
    paper_drawing_polygon(&drawn, (double[]){3, 2, 8, 2, 8, 6, 3, 6}, 4);
    paper_drawing_number(&drawn, '*', 1 - 0.08 * turn, false);
    struct paper_drawing drawing = {drawn.at, drawn.count, 1};
    struct paper_screen screen = {
        .width_px = 5, .height_px = 4, .gray = gray, .drawing = turn % 2 ? &drawing : NULL};
    paper_history_mark(sheet);
    sample_check(
        paper_sheet_put(sheet, &screen, 3 + turn, 2 + turn, (double[]){1, 0.2 * turn, 0.3}));
    free(drawn.at);
    for (int step = 0; step < steps; step++)
        sample_check(paper_sheet_step(sheet));
}

static inline void sample_paint(struct paper_sheet *sheet, int turns)
{
    for (int i = 0; i < turns; i++)
        sample_turn(sheet, i, 3);
}

static inline struct paper_sheet *sample_sheet(uint64_t seed)
{
    struct paper_sheet_config config =
        sheet_of_two(SAMPLE_WIDTH, SAMPLE_HEIGHT, "burnt umber", "phthalo green");
    config.seed = seed;
    config.deckled = seed % 6 == 2; /* 8 is one */
    config.deckle = (struct paper_deckle){.margin = 2, .waves = 1, .thin = 2, .fringe = 1};
    struct paper_sheet *sheet;
    sample_check(paper_sheet_create(&config, &sheet));
    sample_check(paper_history_begin(sheet, 1e6));
    return sheet;
}

static inline uint8_t *sample_file_read(const char *path, size_t *count)
{
    FILE *file = fopen(path, "rb");
    uint8_t *bytes = malloc(1 << 22);
    if (!file || !bytes)
        abort();
    *count = fread(bytes, 1, 1 << 22, file);
    fclose(file);
    return bytes;
}

static inline void sample_file_write(const char *path, const uint8_t *bytes, size_t count)
{
    FILE *file = fopen(path, "wb");
    if (!file || fwrite(bytes, 1, count, file) != count || fclose(file) != 0)
        abort();
}

/* Makes the header agree with the changed bytes, as a forger would; of that version of the
 * model. */
static inline void sample_header_mend_of(uint8_t *bytes, size_t count, int model)
{
    char text[SAMPLE_HEADER] = "";
    if (count < SAMPLE_HEADER)
        return;
    uLong sum = crc32(crc32(0, NULL, 0), bytes + SAMPLE_HEADER, (uInt)(count - SAMPLE_HEADER));
    for (int i = 0; i < 2; i++) {
        snprintf(text, sizeof text,
                 "LUTETIA STATE 2\nmodel %d\nprogram 0\nbytes %zu\nchecksum %08lx\nsheets 1\n",
                 model, count, i ? sum : 0);
        sum = i ? sum : crc32(sum, (const Bytef *)text, sizeof text);
    }
    memcpy(bytes, text, sizeof text);
}

static inline void sample_header_mend(uint8_t *bytes, size_t count)
{
    sample_header_mend_of(bytes, count, PAPER_MODEL_VERSION);
}

/* Loads every sheet of the file. Returns PAPER_OK, or the status of the first failure. */
static inline enum paper_status sample_load_all(const char *path)
{
    struct paper_state *state;
    struct paper_sheet *sheet;
    enum paper_status status = paper_state_open(path, &state);
    for (int i = 0; status == PAPER_OK && i < paper_state_count(state); i++) {
        status = paper_state_load(state, i, i % 2, 1e6, &sheet);
        if (status == PAPER_OK)
            status = paper_sheet_step(sheet);
        if (status == PAPER_OK)
            paper_history_undo(sheet, 2);
        double total;
        if (status == PAPER_OK)
            status = paper_sheet_total(sheet, 0, &total);
        paper_sheet_destroy(sheet);
    }
    paper_state_close(state);
    return status;
}

#endif
