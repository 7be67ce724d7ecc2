/* light_recording.c - frames out of pieces of a recording. */
#include "light_recording.h"
#include "display_internal.h"

#include <stdbool.h>
#include <string.h>

/* The length in bytes of the item that begins the held bytes; 0 if more bytes are needed to
 * tell. */
static size_t length_of(const struct light_reader *reader)
{
    size_t looked = reader->held < LIGHT_RECORDING_LINE_BYTES
                        ? reader->held
                        : (size_t)LIGHT_RECORDING_LINE_BYTES;
    if (memcmp(reader->bytes, LIGHT_RECORDING_LINE, looked < 8 ? looked : 8) == 0)
        return looked < 8 && reader->begun ? 0 : LIGHT_RECORDING_LINE_BYTES;
    return reader->begun ? LIGHT_RECORDING_FRAME_BYTES : SIZE_MAX;
}

static void frame_take(struct light_reader *reader)
{
    struct light_frame frame = {.number = reader->frames++};
    for (int i = 0; i < 8; i++)
        frame.time_us |= (uint64_t)reader->bytes[i] << 8 * i;
    memcpy(frame.lights, reader->bytes + 8, sizeof frame.lights);
    reader->stopped = !reader->take(reader->context, &frame);
}

enum display_status light_reader_feed(struct light_reader *reader, const uint8_t *bytes,
                                      size_t count)
{
    while (count > 0 && !reader->stopped) {
        size_t whole = length_of(reader);
        size_t wanted = whole && whole != SIZE_MAX ? whole : 8;
        size_t step = wanted - reader->held < count ? wanted - reader->held : count;
        memcpy(reader->bytes + reader->held, bytes, step);
        reader->held += step;
        bytes += step;
        count -= step;
        whole = length_of(reader);
        bool is_line = whole == LIGHT_RECORDING_LINE_BYTES;
        if (whole == SIZE_MAX ||
            (is_line && memcmp(reader->bytes, LIGHT_RECORDING_LINE, reader->held) != 0))
            return display_fail(
                DISPLAY_BAD_FILE,
                "no recording of lights at byte %llu: it must be \"%.19s\" there",
                (unsigned long long)reader->read, LIGHT_RECORDING_LINE);
        if (!whole || reader->held < whole)
            continue;
        if (is_line)
            reader->begun = 1;
        else
            frame_take(reader);
        reader->read += reader->held;
        reader->held = 0;
    }
    return DISPLAY_OK;
}

enum display_status light_reader_end(const struct light_reader *reader)
{
    if (reader->stopped || (reader->begun && !reader->held))
        return DISPLAY_OK;
    return reader->begun ? display_fail(DISPLAY_BAD_FILE, "ends within frame %llu",
                                        (unsigned long long)reader->frames)
                         : display_fail(DISPLAY_BAD_FILE, "ends before its first line does");
}
