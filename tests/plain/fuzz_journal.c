/* fuzz_journal.c - opens forged journals: any bytes are changed, and where the input says so
 * the checksums of head and entries are made to agree. Each must open, with as much as is good
 * of it, or be refused as a bad file; then the sheet can be computed, or says why not. */
#include <brush.h>
#include <journal.h>

#include "state_sample.h"

#include <bytes.h>
#include <unistd.h>

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

static char folder[64] = "/tmp/lutetia-journal-XXXXXX", path[96];
static uint8_t *good;
static size_t good_count, head_count;

static void folder_remove(void)
{
    unlink(path);
    rmdir(folder);
}

static void paint(struct paper_sheet *sheet)
{
    struct paper_brush brush = paper_brush_default();
    brush.bristles = 5;
    const struct paper_stroke_sample samples[2] = {
        {.x = 3, .y = 4, .pressure = 0.5}, {.time_s = 0.1, .x = 9, .y = 7, .pressure = 1}};
    sample_check(paper_sheet_brush(sheet, &brush));
    sample_check(paper_sheet_dip(
        sheet, &(struct paper_dip){.part = 1, .side = {-1, 1}, .amount = {1, 0.4, 0.2}}));
    sample_check(paper_sheet_stroke(
        sheet, &(struct paper_stroke){.pace = 60, .samples_count = 2, .samples = samples},
        NULL));
    paper_history_undo(sheet, 1);
    paper_history_redo(sheet, 1);
    sample_check(paper_history_insert_begin(sheet, 2));
    sample_turn(sheet, 1, 2);
    sample_check(paper_history_insert_end(sheet, true));
    sample_check(paper_history_seek(sheet, 5));
}

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    struct paper_journal *journal;
    (void)argc;
    (void)argv;
    if (!mkdtemp(folder))
        abort();
    atexit(folder_remove);
    snprintf(path, sizeof path, "%s/a.journal", folder);
    struct paper_sheet *sheet = sample_sheet(6);
    sample_check(paper_journal_begin(sheet, path, NULL, &journal));
    free(sample_file_read(path, &head_count));
    sample_paint(sheet, 2);
    paint(sheet);
    sample_check(paper_journal_close(journal));
    paper_sheet_destroy(sheet);
    good = sample_file_read(path, &good_count);
    return 0;
}

static void sum_mend(uint8_t *sum, const uint8_t *bytes, size_t count)
{
    const uint64_t digest = event_digest(bytes, count);
    for (int i = 0; i < 8; i++)
        sum[i] = (uint8_t)(digest >> 8 * i);
}

static void sums_mend(uint8_t *file, size_t length)
{
    if (length >= head_count)
        sum_mend(file + head_count - 8, file, head_count - 8);
    for (size_t at = head_count; at + 12 <= length;) {
        const size_t count = file[at] | (size_t)file[at + 1] << 8 | (size_t)file[at + 2] << 16 |
                             (size_t)file[at + 3] << 24;
        if (count > length - at - 12)
            return;
        sum_mend(file + at + 4, file + at + 12, count);
        at += 12 + count;
    }
}

/* Each five bytes of input are one change: where (3 bytes), what (1), how (1); the number of
 * them says whether sums agree. */
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    uint8_t *file = malloc(good_count);
    size_t length = good_count;
    struct paper_journal_found found;
    struct paper_sheet *sheet;
    if (!file)
        abort();
    memcpy(file, good, good_count);
    for (size_t i = 0; i + 5 <= count; i += 5) {
        const size_t at =
            (bytes[i] | (size_t)bytes[i + 1] << 8 | (size_t)bytes[i + 2] << 16) % good_count;
        if (bytes[i + 4] < 8)
            length = at;
        else if (bytes[i + 4] < 128)
            file[at] = bytes[i + 3];
        else
            file[at] ^= (uint8_t)(1 << bytes[i + 3] % 8);
    }
    if (count % 5 != 1)
        sums_mend(file, length);
    sample_file_write(path, file, length);
    free(file);
    enum paper_status status = paper_journal_open(path, NULL, 1e6, &found, &sheet);
    if (status != PAPER_OK && status != PAPER_BAD_FILE) {
        fprintf(stderr, "status %d: %s\n", (int)status, paper_error());
        abort();
    }
    double total;
    const struct paper_sheet_config *config = sheet ? paper_sheet_get_config(sheet) : NULL;
    if (sheet && paper_sheet_steps(sheet) < 200 && config->width * config->height < 10000) {
        status = paper_sheet_total(sheet, 0, &total);
        if (status != PAPER_OK && paper_error()[0] == '\0')
            abort();
    }
    paper_sheet_destroy(sheet);
    return 0;
}

#ifndef LUTETIA_FUZZ_LIBFUZZER
#include "../sample.h"

/* Without libFuzzer: the same inputs in every run, with one change each, or with four. */
int main(int argc, char **argv)
{
    int files = argc > 1 ? atoi(argv[1]) : 300;
    uint8_t bytes[21] = {0};
    uint64_t state = 12;
    LLVMFuzzerInitialize(NULL, NULL);
    LLVMFuzzerTestOneInput(bytes, 0);
    for (int i = 0; i < files; i++) {
        for (size_t j = 0; j < sizeof bytes; j++)
            bytes[j] = (uint8_t)sample_word(&state);
        LLVMFuzzerTestOneInput(bytes, i % 3 ? i % 2 ? 5 : 20 : 21);
    }
    return 0;
}
#endif
