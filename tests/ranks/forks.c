/* forks.c - a program that forks, reads its input, and starts others: as one process, and as
 * several ranks.
 *
 *     printf 'a line' | mpirun -n 3 forks */
#include <cm/paris.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

/* A child has what was computed, if it is one process's; of ranks it has none, and is told. */
static void fork_off(field) CM_field_id_t field;
{
    int status = 0;
    pid_t child;
    fflush(stdout);
    child = fork();
    if (child == 0) {
        printf("the child reads %u\n", CM_u_read_from_processor_1L(65003, field, 32));
        fflush(stdout);
        _exit(0);
    }
    waitpid(child, &status, 0);
    printf("the child ended with %d\n", WIFEXITED(status) ? WEXITSTATUS(status) : -1);
}

int main()
{
    char line[80];
    int sizes[2];
    CM_field_id_t field;
    if (!fgets(line, sizeof line, stdin))
        return 1;
    printf("read \"%s\"\n", line);
    sizes[0] = 256;
    sizes[1] = 256;
    CM_init();
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(sizes, 2)));
    field = CM_allocate_stack_field(32);
    CM_my_send_address(field);
    CM_u_add_constant_2_1L(field, 7, 32);
    printf("the first is %u\n", CM_u_read_from_processor_1L(0, field, 32));
    fork_off(field);
    printf("the sum is %u\n", CM_global_u_add_1L(field, 32));
    fflush(stdout);
    system("echo another program");
    printf("the last is %u\n", CM_u_read_from_processor_1L(65535, field, 32));
    return 3;
}
