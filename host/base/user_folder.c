/* user_folder.c - see user_folder.h. */
#include "user_folder.h"

#include "input_file.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <grp.h>
#include <limits.h>
#include <pthread.h>
#include <pwd.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- is it ours alone? ---- */

/* Whether a user of another number has that group as his first: a group's list of members has
 * no such users. */
static bool first_group_of_another(gid_t group, uid_t user)
{
    static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
    bool found = false;
    pthread_mutex_lock(&lock); /* getpwent() has one place in the list */
    setpwent();
    for (const struct passwd *one; !found && (one = getpwent());)
        found = one->pw_gid == group && one->pw_uid != user;
    endpwent();
    pthread_mutex_unlock(&lock);
    return found;
}

/* Many systems give each user a group of the same name, with only that user in it, and let
 * it write. Such a group counts as the user. */
static bool group_is_ours(gid_t group)
{
    struct passwd user, *user_found = NULL;
    struct group entry, *found = NULL;
    char names[2][4096];
    if (getpwuid_r(geteuid(), &user, names[0], sizeof names[0], &user_found) || !user_found ||
        getgrgid_r(group, &entry, names[1], sizeof names[1], &found) || !found)
        return false;
    if (user.pw_gid != group || strcmp(user.pw_name, entry.gr_name) != 0)
        return false;
    for (char **member = entry.gr_mem; *member; member++)
        if (strcmp(*member, user.pw_name) != 0)
            return false;
    return !first_group_of_another(group, user.pw_uid);
}

/* If root lets a group write to a folder (as to /usr/local in some systems), that is root's
 * decision. */
static bool others_write(const struct stat *s)
{
    return (s->st_mode & S_IWOTH) ||
           ((s->st_mode & S_IWGRP) && s->st_uid != 0 && !group_is_ours(s->st_gid));
}

/* Checks a parent folder: it belongs to this user or root, and others cannot replace its
 * entries. */
static const char *parent_wrong(const struct stat *s)
{
    if (s->st_uid != geteuid() && s->st_uid != 0)
        return "a folder above it belongs to another user";
    if (!(s->st_mode & S_ISVTX) && others_write(s))
        return "others may write to a folder above it";
    return NULL;
}

static const char *folder_wrong(const char *path)
{
    struct stat status;
    if (lstat(path, &status) != 0)
        return "it cannot be looked at";
    if (S_ISLNK(status.st_mode))
        return "it is a link";
    if (!S_ISDIR(status.st_mode))
        return "it is no folder";
    if (status.st_uid != geteuid())
        return "it belongs to another user";
    if (others_write(&status))
        return "others may write to it";
    if (access(path, W_OK | X_OK) != 0)
        return "it cannot be written to";
    return NULL;
}

/* The home folder may be reached by links; the folders that are checked are those of the
 * resolved path. */
static const char *parents_wrong(const char *path)
{
    char real[PATH_MAX];
    if (!realpath(path, real))
        return "it cannot be looked at";
    for (char *slash; (slash = strrchr(real, '/'));) {
        struct stat status;
        *slash = '\0';
        if (stat(*real ? real : "/", &status) != 0)
            return "it cannot be looked at";
        const char *wrong = parent_wrong(&status);
        if (wrong)
            return wrong;
    }
    return NULL;
}

const char *user_folder_wrong(const char *path)
{
    const char *wrong = folder_wrong(path);
    return wrong ? wrong : parents_wrong(path);
}

const char *user_program_wrong(const char *path)
{
    struct stat status;
    if (stat(path, &status) != 0 || !S_ISREG(status.st_mode) || access(path, X_OK) != 0)
        return "it is no program";
    if (status.st_uid != 0 && status.st_uid != geteuid())
        return "it belongs to another user";
    if (others_write(&status))
        return "others may write to it";
    return parents_wrong(path);
}

void user_folder_make(const char *path)
{
    char part[USER_FOLDER_MAX];
    int n = snprintf(part, sizeof part, "%s", path);
    for (char *at = part + 1; n > 0 && n < USER_FOLDER_MAX && *at; at++)
        if (*at == '/') {
            *at = '\0';
            mkdir(part, 0700);
            *at = '/';
        }
    mkdir(path, 0700);
}

/* ---- the temporary folder ---- */

enum { TRIES = 16 };

static struct {
    pthread_mutex_t lock;
    char path[USER_FOLDER_MAX / 2];
    int held; /* the folder, locked as long as the process lives */
    pid_t owner;
} temporary = {.lock = PTHREAD_MUTEX_INITIALIZER, .held = -1};

static int entry_remove(const char *path, const struct stat *status, int kind, struct FTW *at)
{
    (void)status;
    (void)kind;
    (void)at;
    remove(path);
    return 0;
}

static void tree_remove(const char *path)
{
    nftw(path, entry_remove, 16, FTW_DEPTH | FTW_PHYS | FTW_MOUNT);
}

/* Only the process that made the folder removes it; a forked child leaves it alone. */
static void temporary_remove(void)
{
    if (temporary.owner == getpid())
        tree_remove(temporary.path);
}

/* Removes the temporary folders of that kind of this user's dead processes. */
static void temporaries_sweep(const char *where, const char *begin)
{
    DIR *names = opendir(where);
    for (struct dirent *e; names && (e = readdir(names));) {
        char path[PATH_MAX];
        struct stat status;
        if (strncmp(e->d_name, begin, strlen(begin)) != 0)
            continue;
        int folder = input_folder_descriptor(dirfd(names), e->d_name);
        if (folder < 0)
            continue;
        if (fstat(folder, &status) == 0 && status.st_uid == geteuid() &&
            flock(folder, LOCK_EX | LOCK_NB) == 0 &&
            snprintf(path, sizeof path, "%s/%s", where, e->d_name) < (int)sizeof path)
            tree_remove(path);
        close(folder);
    }
    if (names)
        closedir(names);
}

/* Makes and locks a temporary folder; its descriptor, which holds the lock, stays open. Between
 * making and locking, another process that sweeps may take it for a dead process's and remove
 * it; then another folder is made. */
static int locked_make(const char *kind, char *path, size_t room)
{
    char begin[32];
    const char *where = getenv("TMPDIR");
    if (!where || *where != '/' || strlen(where) > room / 2)
        where = "/tmp";
    snprintf(begin, sizeof begin, "lutetia-%s-", kind);
    temporaries_sweep(where, begin);
    for (int i = 0; i < TRIES; i++) {
        struct stat status;
        snprintf(path, room, "%s/%sXXXXXX", where, begin);
        if (!mkdtemp(path))
            return -1;
        const int held = input_folder_descriptor(AT_FDCWD, path);
        if (held >= 0 && flock(held, LOCK_EX) == 0 && fstat(held, &status) == 0 &&
            status.st_nlink > 0)
            return held;
        if (held >= 0)
            close(held);
        rmdir(path);
    }
    errno = EEXIST;
    return -1;
}

bool user_folder_temporary(const char *kind, char *path, size_t room)
{
    return locked_make(kind, path, room) >= 0;
}

static bool temporary_make(void)
{
    temporary.held = locked_make("cache", temporary.path, sizeof temporary.path);
    if (temporary.held < 0)
        return false;
    temporary.owner = getpid();
    atexit(temporary_remove);
    return true;
}

/* A forked child uses its parent's folder, which exists as long as the parent does. */
static bool temporary_folder(const char *name, char out[static USER_FOLDER_MAX])
{
    pthread_mutex_lock(&temporary.lock);
    bool made = temporary.owner != 0 || temporary_make();
    int n = made ? snprintf(out, USER_FOLDER_MAX, "%s/%s", temporary.path, name) : -1;
    pthread_mutex_unlock(&temporary.lock);
    if (n < 0 || n >= USER_FOLDER_MAX)
        return false;
    user_folder_make(out);
    return folder_wrong(out) == NULL;
}

bool user_cache_folder(const char *name, char out[static USER_FOLDER_MAX], const char **why)
{
    static _Thread_local char said[USER_FOLDER_MAX + 64];
    const char *base = getenv("XDG_CACHE_HOME"), *home = getenv("HOME"), *wrong = NULL;
    int n = -1;
    if (base && *base == '/')
        n = snprintf(out, USER_FOLDER_MAX, "%s/%s", base, name);
    else if (home && *home == '/')
        n = snprintf(out, USER_FOLDER_MAX, "%s/.cache/%s", home, name);
    if (n > 0 && n < USER_FOLDER_MAX) {
        user_folder_make(out);
        wrong = user_folder_wrong(out);
        snprintf(said, sizeof said, "%s: %s", out, wrong ? wrong : "");
    } else {
        wrong = n < 0 ? "neither HOME nor XDG_CACHE_HOME is set"
                      : "HOME or XDG_CACHE_HOME is too long";
        snprintf(said, sizeof said, "%s", wrong);
    }
    if (why)
        *why = wrong ? said : NULL;
    return !wrong || temporary_folder(name, out);
}
