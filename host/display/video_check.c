/* video_check.c - counts a film's packets by ffmpeg's demuxer, which decodes nothing: its muxer
 * `framecrc` prints a line for each, which begins with the stream's number.
 *
 *     #tb 0: 1/12800                    what is about streams
 *     0,     0,     0,   512,   1234, 0xcf6c5a6b
 *     1,     0,     0,  1024,    341, 0x5c2a1b3d */
#include "video_check.h"

#include <streams.h>

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

/* The film is descriptor 3; what ffmpeg says goes to the same pipe as its lines, and is what
 * begins with no number. */
_Noreturn static void reader_become(int file, int output, const char *format)
{
    enum { FILM = 3 };
    const char *const words[] = {"ffmpeg",
                                 "-hide_banner",
                                 "-nostdin",
                                 "-loglevel",
                                 "error",
                                 "-protocol_whitelist",
                                 "file",
                                 "-f",
                                 format,
                                 "-i",
                                 "/proc/self/fd/3",
                                 "-map",
                                 "0",
                                 "-c",
                                 "copy",
                                 "-f",
                                 "framecrc",
                                 "-",
                                 NULL};
    const int nowhere = streams_nowhere(O_RDONLY), film = fcntl(file, F_DUPFD, FILM + 1),
              pipe = fcntl(output, F_DUPFD, FILM + 1);
    dup2(nowhere, STDIN_FILENO);
    dup2(pipe, STDOUT_FILENO);
    dup2(pipe, STDERR_FILENO);
    dup2(film, FILM);
    execvp("ffmpeg", (char *const *)(uintptr_t)words);
    dprintf(STDERR_FILENO, "ffmpeg cannot be run: %s\n", strerror(errno));
    _exit(127);
}

/* Counts the lines of both streams; `said` gets the last one that is neither. */
static void lines_count(FILE *lines, long count[2], char *said, size_t room)
{
    char line[300];
    bool begins = true; /* a longer line comes in pieces */
    while (fgets(line, sizeof line, lines)) {
        const bool whole = strchr(line, '\n') != NULL;
        if (begins && (line[0] == '0' || line[0] == '1') && line[1] == ',')
            count[line[0] - '0']++;
        else if (begins && line[0] != '#' && line[0] != '\n')
            snprintf(said, room, "%.*s", (int)strcspn(line, "\r\n"), line);
        begins = whole;
    }
}

/* Where pictures cannot be counted: a .gif ends with a semicolon, and the last page of an .ogv
 * says that it is the last. */
static bool film_ended(int file, const char *format)
{
    enum { TAIL = 1 << 17, FLAGS = 5, LAST = 4 };
    static const char page[] = "OggS";
    const off_t end = lseek(file, 0, SEEK_END), from = end > TAIL ? end - TAIL : 0;
    char *tail = end > 0 ? malloc(TAIL) : NULL;
    const ssize_t count = tail ? pread(file, tail, TAIL, from) : 0;
    bool ended = false;
    if (count == end - from && strcmp(format, "gif") == 0)
        ended = tail[count - 1] == ';';
    for (ssize_t at = count - FLAGS - 1; at >= 0 && strcmp(format, "ogg") == 0; at--)
        if (memcmp(tail + at, page, sizeof page - 1) == 0) {
            ended = (tail[at + FLAGS] & LAST) != 0;
            break;
        }
    free(tail);
    return ended;
}

bool video_read_back(int file, const struct video_held *held, char *said, size_t room)
{
    int ends[2], status = 0;
    long count[2] = {0, 0};
    *said = '\0';
    if (pipe2(ends, O_CLOEXEC) != 0) {
        snprintf(said, room, "it cannot be read back: %s", strerror(errno));
        return false;
    }
    fflush(NULL);
    const pid_t reader = fork();
    if (reader == 0)
        reader_become(file, ends[1], held->format);
    close(ends[1]);
    FILE *lines = reader > 0 ? fdopen(ends[0], "r") : NULL;
    if (lines) {
        lines_count(lines, count, said, room);
        fclose(lines);
    } else {
        close(ends[0]);
    }
    while (reader > 0 && waitpid(reader, &status, 0) < 0)
        if (errno != EINTR)
            return false;
    if (*said)
        return false;
    const bool all = held->exactly ? count[0] == held->frames
                                   : count[0] > 0 && film_ended(file, held->format);
    if (!lines || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
        snprintf(said, room, "it cannot be read back");
    else if (!all)
        snprintf(said, room, "read back it has %ld pictures of %ld", count[0], held->frames);
    else if (held->sounds && count[1] == 0)
        snprintf(said, room, "read back it has no sound");
    return !*said;
}
