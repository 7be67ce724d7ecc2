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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_are_read),
        cmocka_unit_test(other_things_hold_nobody),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
