/* fuzz_state.c - loads forged states: any bytes are changed, and the header's checksum is made
 * to agree.
 *
 * Each file must load, or be refused as a bad file. libFuzzer's input says which bytes are
 * changed. */
#include "state_sample.h"

#include <unistd.h>

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

static char folder[64] = "/tmp/lutetia-state-XXXXXX", path[96];
static uint8_t *good;
static size_t good_count;

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
    struct paper_sheet *sheet = sample_sheet(6);
    sample_paint(sheet, 2);
    sample_check(paper_state_save(path, &(struct paper_state_sheet){1, sheet}, 1));
    paper_sheet_destroy(sheet);
    good = sample_file_read(path, &good_count);
    return 0;
}

/* Each five bytes of input are one change: where (3 bytes), what (1), how (1). */
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    uint8_t *file = malloc(good_count);
    size_t length = good_count;
    if (!file)
        abort();
    memcpy(file, good, good_count);
    for (size_t i = 0; i + 5 <= count; i += 5) {
        size_t at =
            (bytes[i] | (size_t)bytes[i + 1] << 8 | (size_t)bytes[i + 2] << 16) % good_count;
        if (bytes[i + 4] < 8 && at > SAMPLE_HEADER)
            length = at;
        else if (bytes[i + 4] < 128)
            file[at] = bytes[i + 3];
        else
            file[at] ^= (uint8_t)(1 << bytes[i + 3] % 8);
    }
    sample_header_mend(file, length);
    sample_file_write(path, file, length);
    free(file);
    enum paper_status status = sample_load_all(path);
    if (status != PAPER_OK && status != PAPER_BAD_FILE) {
        fprintf(stderr, "status %d: %s\n", (int)status, paper_error());
        abort();
    }
    return 0;
}

#ifndef LUTETIA_FUZZ_LIBFUZZER
#include "../sample.h"

/* Without libFuzzer: the same inputs in every run, first with one change each, then with
 * several. */
int main(int argc, char **argv)
{
    int files = argc > 1 ? atoi(argv[1]) : 200;
    uint8_t bytes[20] = {0};
    uint64_t state = 12;
    LLVMFuzzerInitialize(NULL, NULL);
    LLVMFuzzerTestOneInput(bytes, 0);
    for (int i = 0; i < files; i++) {
        for (size_t j = 0; j < sizeof bytes; j++)
            bytes[j] = (uint8_t)sample_word(&state);
        LLVMFuzzerTestOneInput(bytes, i % 2 ? 5 : sizeof bytes);
    }
    return 0;
}
#endif
