/* fuzz_bytes.c - parses any bytes in pieces. The messages are the oracle's, and encoding and
 * parsing them again gives the same messages. Any text is a chain of filters or is refused. The
 * first bytes choose the pieces. With libFuzzer it is the target. */
#include "oracle.h"

#include <midi_encoder.h>
#include <midi_filter.h>

#include "../must.h"
#include "../sample.h"

#include <stdio.h>
#include <string.h>

static void parse_in_pieces(const uint8_t *bytes, size_t count, uint64_t seed,
                            struct taken *out)
{
    struct midi_parser parser;
    midi_parser_init(&parser);
    for (size_t at = 0; at < count;) {
        size_t length = 1 + sample_word(&seed) % 9;
        length = length < count - at ? length : count - at;
        midi_parser_take(&parser, at, bytes + at, length, taken_add, out);
        at += length;
    }
    midi_parser_end(&parser, count, taken_add, out);
}

static void chain_use(const char *text, const struct taken *messages)
{
    struct midi_chain *chain;
    struct taken out = {0};
    if (midi_chain_create(text, &chain) != MIDI_OK) {
        must(midi_error()[0]);
        return;
    }
    for (size_t i = 0; i < messages->count; i++)
        midi_chain_take(chain, &messages->messages[i], taken_add, &out);
    midi_chain_flush(chain, UINT64_MAX, taken_add, &out);
    must(out.count <= messages->count);
    for (size_t i = 0; i < out.count; i++)
        must(midi_message_good(&out.messages[i]));
    taken_finish(&out);
    midi_chain_destroy(chain);
}

static void fuzz_one(const uint8_t *bytes, size_t count)
{
    if (count < 2)
        return;
    struct taken expected = {0}, got = {0}, again = {0};
    struct midi_parser_counts counts;
    struct midi_encoder encoder = {.running_status = bytes[0] & 1};
    struct midi_parser parser;
    uint8_t encoded[MIDI_ENCODED_MAX];
    char text[MIDI_TEXT_MAX];
    oracle_parse(bytes + 2, count - 2, &expected, &counts);
    parse_in_pieces(bytes + 2, count - 2, (uint64_t)bytes[0] | (uint64_t)bytes[1] << 8, &got);
    must(taken_equal(&got, &expected));
    midi_parser_init(&parser);
    for (size_t i = 0; i < got.count; i++) {
        size_t length = midi_encoder_put(&encoder, &got.messages[i], encoded);
        must(length > 0);
        midi_parser_take(&parser, 0, encoded, length, taken_add, &again);
        midi_message_text(&got.messages[i], text);
        struct midi_message back;
        if (midi_message_kind(&got.messages[i]) != MIDI_KIND_SYSEX)
            must(midi_message_read(text, &back) == MIDI_OK &&
                 midi_message_equal(&back, &got.messages[i]));
    }
    must(taken_equal(&again, &expected));
    size_t length = count < sizeof text ? count : sizeof text - 1;
    memcpy(text, bytes, length);
    text[length] = '\0';
    chain_use(text, &expected);
    struct midi_message any;
    (void)midi_message_read(text, &any);
    taken_finish(&expected);
    taken_finish(&got);
    taken_finish(&again);
}

#ifdef LUTETIA_FUZZ_TARGET
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    fuzz_one(bytes, count);
    return 0;
}
#else
int main(void)
{
    static const char *const chains[] = {"drop=clock,aftertouch", "channels=1-4,10 notes=c2-c4",
                                         "transpose=-3 velocity=fixed:9 channel=2",
                                         "split=c4:2 thin=20", "note-on 1 c4 100"};
    static uint8_t bytes[600];
    uint64_t seed = 5;
    for (int turn = 0; turn < 3000; turn++) {
        size_t count = sample_word(&seed) % sizeof bytes;
        oracle_bytes(&seed, bytes, count);
        fuzz_one(bytes, count);
        /* A chain with one or two wrong bytes. */
        const char *chain = chains[sample_word(&seed) % 5];
        memcpy(bytes, chain, strlen(chain) + 1);
        for (int k = 0; k < 2; k++)
            bytes[sample_word(&seed) % strlen(chain)] =
                (uint8_t)chain[sample_word(&seed) % strlen(chain)];
        fuzz_one(bytes, strlen(chain));
    }
    printf("3000 seeds\n");
    return 0;
}
#endif
