/* sound_server.c - see sound_server.h. */
#include "sound_server.h"
#include "../clock.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

pid_t program_begin(char *const words[], const char *output, const char *errors)
{
    const pid_t child = fork();
    if (child == 0) {
        const int out = open(output, O_WRONLY | O_CREAT | O_TRUNC, 0600),
                  err = open(errors, O_WRONLY | O_CREAT | O_TRUNC, 0600),
                  nothing = open("/dev/null", O_RDONLY);
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        dup2(nothing, STDIN_FILENO);
        dup2(out, STDOUT_FILENO);
        dup2(err, STDERR_FILENO);
        execvp(words[0], words);
        _exit(127);
    }
    return child;
}

void program_end(pid_t program)
{
    kill(program, SIGKILL);
    waitpid(program, NULL, 0);
}

pid_t sound_server_begin(const char *socket)
{
    char protocol[400];
    snprintf(protocol, sizeof protocol,
             "module-native-protocol-unix auth-anonymous=1 socket=%s", socket);
    unlink(socket);
    char *const words[] = {"pulseaudio",
                           "-n",
                           "--daemonize=no",
                           "--exit-idle-time=-1",
                           "--use-pid-file=no",
                           "-L",
                           "module-null-sink sink_name=room rate=48000",
                           "-L",
                           protocol,
                           NULL};
    return program_begin(words, "/dev/null", "/dev/null");
}

bool sound_server_wait(pid_t server, const char *socket)
{
    const double until_s = clock_now_s() + 10;
    while (access(socket, W_OK) != 0)
        if (clock_now_s() > until_s || waitpid(server, NULL, WNOHANG) != 0 ||
            poll(NULL, 0, 50) < 0)
            return false;
    return true;
}
