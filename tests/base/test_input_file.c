/* test_input_file.c - only regular files are opened for reading, and opening never blocks. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <input_file.h>

#include "../display/scratch.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

static char path[512], other[512];

static void file_write(const char *name, const char *text)
{
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void files_are_read(void **state)
{
    (void)state;
    char bytes[8] = "";
    snprintf(path, sizeof path, "%s", scratch_path("plain.txt"));
    snprintf(other, sizeof other, "%s", scratch_path("link.txt"));
    file_write(path, "hello");
    assert_int_equal(symlink(path, other), 0);
    for (int i = 0; i < 2; i++) {
        FILE *file = input_file_open(i ? other : path, NULL);
        assert_non_null(file);
        assert_int_equal(fread(bytes, 1, sizeof bytes, file), 5);
        assert_memory_equal(bytes, "hello", 5);
        assert_int_equal(fcntl(fileno(file), F_GETFL) & O_NONBLOCK, 0);
        assert_int_not_equal(fcntl(fileno(file), F_GETFD) & FD_CLOEXEC, 0);
        fclose(file);
    }
    unlink(other);
    unlink(path);
}

static void refused(const char *name, int error, const char *says)
{
    const char *why = "";
    errno = 0;
    assert_null(input_file_open(name, &why));
    assert_int_equal(errno, error);
    if (!strstr(why, says))
        fail_msg("it said: %s", why);
}

static void other_things_hold_nobody(void **state)
{
    (void)state;
    alarm(20); /* ends the test */
    snprintf(path, sizeof path, "%s", scratch_path("thing"));
    assert_int_equal(mkfifo(path, 0600), 0);
    refused(path, ENOTSUP, "not a regular file");
    unlink(path);
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    int end = socket(AF_UNIX, SOCK_STREAM, 0);
    assert_true(strlen(path) < sizeof address.sun_path);
    strcpy(address.sun_path, path);
    assert_int_equal(bind(end, (const struct sockaddr *)&address, sizeof address), 0);
    refused(path, ENOTSUP, "not a regular file");
    close(end);
    unlink(path);
    refused("/dev/null", ENOTSUP, "not a regular file");
    refused("/", EISDIR, "directory");
    refused("/no/such/file", ENOENT, "No such file");
    refused("", ENOENT, "No such file");
    alarm(0);
}

/* A file of so many bytes, each its place's lowest bits. */
static void file_fill(const char *name, size_t bytes)
{
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    for (size_t i = 0; i < bytes; i++)
        assert_int_equal(fputc((int)(i & 255), file), (int)(i & 255));
    fclose(file);
}

static void whole_expect(const char *text, size_t bytes, size_t wanted)
{
    assert_non_null(text);
    assert_int_equal(bytes, wanted);
    for (size_t i = 0; i < wanted; i++)
        assert_int_equal((unsigned char)text[i], i & 255);
    assert_int_equal(text[wanted], 0);
}

static void files_are_read_whole(void **state)
{
    (void)state;
    const size_t sizes[] = {0, 1, 4095, 4096, 16384, 16385, 70000};
    snprintf(path, sizeof path, "%s", scratch_path("whole"));
    snprintf(other, sizeof other, "%s", scratch_path("whole.link"));
    assert_int_equal(symlink(path, other), 0);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        const size_t n = sizes[i], room[] = {n, n + 1, SIZE_MAX / 4};
        const char *why = NULL;
        size_t bytes = 77;
        char *text;
        file_fill(path, n);
        for (size_t k = 0; k < sizeof room / sizeof *room; k++) {
            text = input_file_read(k == 1 ? other : path, room[k], &bytes, &why);
            whole_expect(text, bytes, n);
            free(text);
        }
        if (n > 0) {
            assert_null(input_file_read(path, n - 1, &bytes, &why));
            assert_int_equal(errno, EFBIG);
            assert_int_equal(bytes, 0);
            assert_non_null(strstr(why, "too large"));
        }
        text = input_file_read_no_link(path, n, &bytes, NULL);
        whole_expect(text, bytes, n);
        free(text);
        assert_null(input_file_read_no_link(other, n, &bytes, &why));
        assert_int_equal(errno, ELOOP);
    }
    unlink(other);
    unlink(path);
}

static void what_is_no_file_is_not_read(void **state)
{
    (void)state;
    const char *const names[] = {"/no/such/file", "/", "/dev/zero", ""};
    const int errors[] = {ENOENT, EISDIR, ENOTSUP, ENOENT};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const char *why = NULL;
        size_t bytes = 77;
        assert_null(input_file_read(names[i], 100, &bytes, &why));
        assert_int_equal(errno, errors[i]);
        assert_int_equal(bytes, 0);
        assert_non_null(why);
    }
    /* The system says that a file of /proc has no bytes. */
    size_t bytes;
    char *text = input_file_read("/proc/self/status", 1 << 20, &bytes, NULL);
    assert_non_null(text);
    assert_true(bytes > 100);
    free(text);
}

static void pipes_are_read_whole(void **state)
{
    (void)state;
    const size_t sizes[] = {0, 1, 16384, 40000};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        const char *why = NULL;
        size_t bytes;
        int ends[2];
        assert_int_equal(pipe(ends), 0); /* which holds 65,536 bytes */
        for (size_t k = 0; k < sizes[i]; k++)
            assert_int_equal(write(ends[1], &(unsigned char){(unsigned char)k}, 1), 1);
        close(ends[1]);
        FILE *in = fdopen(ends[0], "rb");
        assert_non_null(in);
        char *text = input_stream_read(in, sizes[i] - sizes[i] / 2, &bytes, &why);
        if (sizes[i] > 1) {
            assert_null(text);
            assert_int_equal(errno, EFBIG);
        } else {
            whole_expect(text, bytes, sizes[i]);
        }
        free(text);
        fclose(in);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_are_read),
        cmocka_unit_test(files_are_read_whole),
        cmocka_unit_test(what_is_no_file_is_not_read),
        cmocka_unit_test(pipes_are_read_whole),
        cmocka_unit_test(other_things_hold_nobody),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
