/* Memory shared by a program and who shows its pictures: slots, and who finds the room. */
#include <picture_room.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

static void slots_are_taken_and_given(void **unused)
{
    (void)unused;
    struct picture_room room = {0};
    assert_int_equal(picture_room_take(&room), -1); /* there is none */
    picture_room_end(&room);
    assert_true(picture_room_make(&room));
    assert_true(room.descriptor >= 3);
    for (int i = 0; i < PICTURE_ROOM_SLOTS; i++) {
        assert_int_equal(picture_room_take(&room), i);
        picture_room_slot(&room, i)[0] =
            picture_room_slot(&room, i)[PICTURE_ROOM_SLOT_BYTES - 1] = (uint8_t)(i + 1);
    }
    assert_int_equal(picture_room_take(&room), -1);
    for (int i = 0; i < PICTURE_ROOM_SLOTS; i++) {
        assert_int_equal(picture_room_slot(&room, i)[0], i + 1);
        assert_int_equal(picture_room_slot(&room, i)[PICTURE_ROOM_SLOT_BYTES - 1], i + 1);
    }
    picture_room_give(&room, 5);
    assert_int_equal(picture_room_take(&room), 5);
    picture_room_end(&room);
}

static void only_the_other_end_finds_it(void **unused)
{
    (void)unused;
    struct picture_room room, found;
    char text[PICTURE_ROOM_TEXT], wrong[PICTURE_ROOM_TEXT + 8];
    assert_true(picture_room_make(&room));
    picture_room_text(&room, "/dev/fd/7", text);
    assert_false(picture_room_find(&found, NULL, "/dev/fd/7"));
    assert_false(picture_room_find(&found, text, "film.display"));
    assert_false(picture_room_find(&found, "", ""));
    assert_false(picture_room_find(&found, "1 2", ""));
    assert_false(picture_room_find(&found, "99999999999999 2 /dev/fd/7", "/dev/fd/7"));
    assert_false(picture_room_find(&found, "-1 2 /dev/fd/7", "/dev/fd/7"));
    snprintf(wrong, sizeof wrong, "%d 12345%s", room.descriptor, strchr(text, ' ') + 1);
    assert_false(picture_room_find(&found, wrong, "/dev/fd/7")); /* another file's number */
    /* A file that may become shorter. */
    FILE *file = tmpfile();
    assert_non_null(file);
    snprintf(wrong, sizeof wrong, "%d%s", fileno(file), strchr(text, ' '));
    assert_false(picture_room_find(&found, wrong, "/dev/fd/7"));
    fclose(file);
    assert_int_not_equal(ftruncate(room.descriptor, 4096), 0);

    /* What a child writes is here. */
    const pid_t child = fork();
    if (child == 0) {
        const bool good =
            picture_room_find(&found, text, "/dev/fd/7") && picture_room_take(&found) == 0;
        if (good)
            strcpy((char *)picture_room_slot(&found, 0), "picture");
        _exit(good ? 0 : 1);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
    assert_string_equal((char *)picture_room_slot(&room, 0), "picture");
    assert_int_equal(picture_room_take(&room), 1);
    picture_room_give(&room, 0);
    assert_int_equal(picture_room_take(&room), 0);
    picture_room_end(&room);
    assert_null(room.at);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(slots_are_taken_and_given),
                                       cmocka_unit_test(only_the_other_end_finds_it)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
