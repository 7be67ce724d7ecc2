/* The memory that a program shares with its window (picture_room.h), when the other side is
 * hostile. A thread writes to all of it, the slots' words too, while the window's side reads
 * pieces that name slots which it was given, was not given, or which there are none of; and
 * while the program's side takes slots and fills them. Nothing outside may be touched, and no
 * one waits. `build/tests/display/fuzz_room 900` goes on for a quarter of an hour. */
#include <display_recording.h>

#include <fcntl.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cmocka.h>

#include "clock.h"
#include "display_pieces.h"
#include "sample.h"

enum { WORDS_PAGE = 4096, ROUNDS = 3000 };

#define ROOM_BYTES                                                                             \
    ((size_t)WORDS_PAGE + (size_t)PICTURE_ROOM_SLOTS * (size_t)PICTURE_ROOM_SLOT_BYTES)

static double seconds; /* 0: so many rounds */
static uint64_t random_state = 11;
static struct pieces pieces;

static int below(int count)
{
    return (int)(sample_word(&random_state) % (uint64_t)count);
}

/* ---- the other side ---- */

static struct picture_room other;
static atomic_bool enough;

/* The slots' words, and each slot's first and last bytes: pixels as tests use them. */
static void *scribble(void *unused)
{
    uint64_t state = 5;
    (void)unused;
    while (!enough) {
        const uint64_t word = sample_word(&state);
        const int slot = (int)(word % PICTURE_ROOM_SLOTS);
        uint8_t *at = picture_room_slot(&other, slot);
        if (word >> 8 & 1)
            ((volatile uint8_t *)other.at)[word >> 16 & (WORDS_PAGE - 1)] =
                (uint8_t)(word >> 32);
        else if (word >> 9 & 1)
            picture_room_give(&other, slot);
        at[word >> 16 & 0xfff] = (uint8_t)(word >> 40);
        at[PICTURE_ROOM_SLOT_BYTES - 1 - (word >> 28 & 0xff)] = (uint8_t)(word >> 48);
    }
    return NULL;
}

/* The same memory, mapped a second time, as the other process has it. */
static void other_begin(const struct picture_room *room, pthread_t *thread)
{
    char text[PICTURE_ROOM_TEXT];
    picture_room_text(room, "-", text);
    assert_true(picture_room_find(&other, text, "-"));
    enough = false;
    assert_int_equal(pthread_create(thread, NULL, scribble, NULL), 0);
}

static void other_end(pthread_t thread, struct picture_room *room)
{
    enough = true;
    pthread_join(thread, NULL);
    munmap(other.at, ROOM_BYTES); /* the descriptor is the room's */
    other.at = NULL;
    picture_room_end(room);
}

static bool go_on(int round, double began_s)
{
    return seconds > 0 ? clock_now_s() < began_s + seconds : round < ROUNDS;
}

/* ---- the window's side ---- */

static int change_take(void *context, const struct display_change *change)
{
    (void)context, (void)change;
    return 1;
}

static uint32_t number_odd(void)
{
    static const uint32_t odd[] = {
        0,  1, 7, 8, 9, 0x7fffffff, 0x80000000, 0xffffffff, 0xfffffffc, 1 << 24, (1 << 24) + 1,
        12, 48};
    return below(3) ? odd[below(sizeof odd / sizeof *odd)]
                    : (uint32_t)sample_word(&random_state);
}

static void room_piece(const struct display_screen *s, int number)
{
    const int whole = below(2);
    const uint32_t columns = whole || below(2) ? (uint32_t)s->width_px : number_odd();
    const uint64_t all =
        (uint64_t)s->width_px * (uint64_t)s->height_px * (uint64_t)s->pixel_bytes;
    const uint32_t bytes = whole || below(2) ? (uint32_t)all : number_odd();
    pieces_head(&pieces, 7, number, below(2), s->pixel_bytes, 12, 3,
                whole ? 0 : (int)number_odd(), whole ? 0 : (int)number_odd());
    pieces_number(&pieces, columns, 4);
    pieces_number(&pieces, below(8) ? (uint64_t)below(PICTURE_ROOM_SLOTS) : number_odd(), 4);
    pieces_number(&pieces, bytes, 4);
}

/* One piece, or damage. */
static void piece_any(struct display_reader *reader)
{
    uint8_t pixels[64], map[256][3];
    const int number = 1 + below(2), die = below(16);
    const struct display_screen *s = &reader->screens[number - 1];
    static const int sides[] = {1, 2, 4, 3, 9, 64, 1024, 2048};
    if (!s->there || die == 0) {
        pieces_size(&pieces, number, below(2) ? 1 : 4, sides[below(8)], sides[below(8)], 1);
    } else if (die == 1) {
        memset(pixels, below(256), sizeof pixels);
        pieces_pixels(&pieces, number, below(2), s->pixel_bytes, 4, 4, below(9) - 4,
                      below(9) - 4, pixels, 2);
    } else if (die == 2) {
        pieces_head(&pieces, 3, number, below(2), 0, 0, 2, (int)number_odd(), 0);
    } else if (die == 3) {
        for (size_t i = 0; i < sizeof map; i++)
            (&map[0][0])[i] = (uint8_t)sample_word(&random_state);
        pieces_map(&pieces, number, map, 3);
    } else if (die == 4) {
        pieces_view(&pieces, number, below(2), 1 + below(4), 1 + below(256), (int)number_odd(),
                    (int)number_odd(), 4);
    } else if (die == 5) {
        pieces_head(&pieces, 6, number, 0, 0, 0, 5, 0, 0);
    } else {
        room_piece(s, number);
    }
    if (below(40) == 0)
        pieces.bytes[below((int)pieces.count)] ^= (uint8_t)(1 << below(8));
}

static void screens_are_drawn(const struct display_reader *reader, uint32_t *pixels)
{
    for (int i = 0; i < DISPLAY_SCREENS; i++) {
        const struct display_screen *s = &reader->screens[i];
        struct display_image image = {0};
        if (!s->there || (long)s->width_px * s->height_px > 1 << 21)
            continue;
        display_screen_paint(s, &(struct display_room){pixels, (size_t)s->width_px});
        if (below(8) == 0)
            assert_int_equal(display_screen_picture(s, &image), DISPLAY_OK);
        display_image_destroy(&image);
    }
}

static void a_window_bears_a_hostile_program(void **unused)
{
    (void)unused;
    struct picture_room room;
    pthread_t thread;
    uint32_t *pixels = malloc(sizeof *pixels << 21);
    int taken = 0, refused = 0;
    const double began_s = clock_now_s();
    assert_non_null(pixels);
    if (!picture_room_make(&room))
        skip();
    other_begin(&room, &thread);
    for (int round = 0; go_on(round, began_s); round++) {
        struct display_reader reader = {.take = change_take, .shared = &room};
        enum display_status status = DISPLAY_OK;
        for (int piece = 0; status == DISPLAY_OK && piece < 12; piece++) {
            pieces.count = 0;
            if (!piece)
                pieces_line(&pieces);
            piece_any(&reader);
            status = display_reader_feed(&reader, pieces.bytes, pieces.count);
            taken += status == DISPLAY_OK;
            if (status == DISPLAY_OK && below(4) == 0)
                screens_are_drawn(&reader, pixels);
            const int number = 1 + below(DISPLAY_SCREENS);
            display_reader_keep(&reader, number,
                                display_screen_as_is(&reader.screens[number - 1]) != NULL);
        }
        refused += status != DISPLAY_OK;
        if (status != DISPLAY_OK)
            assert_null(strchr(display_error(), '\n'));
        screens_are_drawn(&reader, pixels);
        display_reader_finish(&reader);
    }
    other_end(thread, &room);
    free(pixels);
    assert_true(taken > ROUNDS && refused > ROUNDS / 10);
}

/* ---- the program's side ---- */

static void a_program_bears_a_hostile_window(void **unused)
{
    (void)unused;
    struct picture_room room;
    pthread_t thread;
    int taken = 0, none = 0;
    const double began_s = clock_now_s();
    if (!picture_room_make(&room))
        skip();
    other_begin(&room, &thread);
    for (int round = 0; go_on(round, began_s) || !taken || !none; round++) {
        const int slot = picture_room_take(&room);
        assert_in_range(slot + 1, 0, PICTURE_ROOM_SLOTS);
        taken += slot >= 0;
        none += slot < 0;
        if (slot < 0) {
            picture_room_give(&room, below(PICTURE_ROOM_SLOTS));
            continue;
        }
        memset(picture_room_slot(&room, slot), round, 4096);
        picture_room_slot(&room, slot)[PICTURE_ROOM_SLOT_BYTES - 1] = (uint8_t)round;
        if (below(2))
            picture_room_give(&room, slot);
    }
    other_end(thread, &room);
}

/* What the variable may hold: a room is found by its own text alone. */
static void texts_of_all_kinds_find_nothing(void **unused)
{
    (void)unused;
    static const char *const parts[] = {
        "0",   "1", "2",         "3",           "-1", " ", "\t",
        "%s",  "-", "/dev/fd/5", "99999999999", "\n", "x", "18446744073709551615",
        "0x5", "+4"};
    struct picture_room room, found;
    char text[PICTURE_ROOM_TEXT], own[PICTURE_ROOM_TEXT];
    if (!picture_room_make(&room))
        skip();
    picture_room_text(&room, "-", own);
    for (int round = 0; round < 20 * ROUNDS; round++) {
        text[0] = '\0';
        for (int k = below(6); k >= 0; k--)
            strncat(text, parts[below(sizeof parts / sizeof *parts)],
                    sizeof text - strlen(text) - 1);
        if (below(4) == 0) {
            snprintf(text, sizeof text, "%s", own);
            text[below((int)strlen(text))] ^= (char)(1 << below(7));
        }
        if (!picture_room_find(&found, text, "-"))
            continue;
        assert_int_equal(found.descriptor, room.descriptor); /* by another spelling */
        munmap(found.at, ROOM_BYTES);
    }
    assert_true(picture_room_find(&found, own, "-"));
    assert_int_equal(found.descriptor, room.descriptor);
    picture_room_end(&room);
}

/* A file that may become shorter, or is, or that cannot be written to. */
static void files_that_would_end_a_reader_are_refused(void **unused)
{
    (void)unused;
    static const int seals[] = {0,
                                F_SEAL_GROW,
                                F_SEAL_GROW | F_SEAL_SEAL,
                                F_SEAL_SHRINK,
                                F_SEAL_SHRINK | F_SEAL_WRITE,
                                F_SEAL_SHRINK | F_SEAL_FUTURE_WRITE};
    const off_t whole = (off_t)ROOM_BYTES;
    const off_t sizes[] = {0, 4096, whole - 1, whole + 1, whole};
    for (size_t i = 0; i < 6; i++)
        for (size_t k = 0; k < 5; k++) {
            const int file = memfd_create("room", MFD_CLOEXEC | MFD_ALLOW_SEALING);
            struct picture_room found, as = {.descriptor = file};
            char text[PICTURE_ROOM_TEXT];
            assert_true(file >= 0);
            assert_int_equal(ftruncate(file, sizes[k]), 0);
            assert_int_equal(fcntl(file, F_ADD_SEALS, seals[i]), 0);
            const bool is = picture_room_find(&found, picture_room_text(&as, "-", text), "-");
            assert_int_equal(is, i == 3 && k == 4);
            if (is)
                picture_room_end(&found);
            else
                close(file);
        }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_window_bears_a_hostile_program),
        cmocka_unit_test(a_program_bears_a_hostile_window),
        cmocka_unit_test(texts_of_all_kinds_find_nothing),
        cmocka_unit_test(files_that_would_end_a_reader_are_refused),
    };
    seconds = argc > 1 ? atof(argv[1]) / 2 : 0;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
