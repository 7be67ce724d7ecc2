/* osc_port.c - see osc_port.h. */
#include "osc_port.h"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

union address {
    struct sockaddr any;
    struct sockaddr_in v4;
    struct sockaddr_in6 v6;
};

struct osc_port {
    int heard, sent; /* sockets; -1 */
    union address from[OSC_FROM_MAX], last;
    int from_count;
    socklen_t last_bytes;
    long dropped;
};

static socklen_t bytes_of(const union address *a)
{
    return a->any.sa_family == AF_INET6 ? sizeof a->v6 : sizeof a->v4;
}

/* Of this computer alone. */
static bool is_loopback(const union address *a)
{
    return a->any.sa_family == AF_INET6 ? IN6_IS_ADDR_LOOPBACK(&a->v6.sin6_addr)
                                        : ntohl(a->v4.sin_addr.s_addr) >> 24 == 127;
}

static bool same_host(const union address *a, const union address *b)
{
    if (a->any.sa_family != b->any.sa_family)
        return false;
    return a->any.sa_family == AF_INET6
               ? memcmp(&a->v6.sin6_addr, &b->v6.sin6_addr, sizeof a->v6.sin6_addr) == 0
               : a->v4.sin_addr.s_addr == b->v4.sin_addr.s_addr;
}

static bool host_read(const char *text, union address *out)
{
    memset(out, 0, sizeof *out);
    if (strcmp(text, "localhost") == 0)
        text = "127.0.0.1";
    if (inet_pton(AF_INET, text, &out->v4.sin_addr) == 1) {
        out->any.sa_family = AF_INET;
        return true;
    }
    out->any.sa_family = AF_INET6;
    return inet_pton(AF_INET6, text, &out->v6.sin6_addr) == 1;
}

/* PORT, ADDRESS:PORT, [ADDRESS]:PORT. */
static bool address_read(const char *text, union address *out)
{
    char host[64] = "127.0.0.1", *end;
    const char *colon = strrchr(text, ':'), *port = colon ? colon + 1 : text;
    size_t length = colon ? (size_t)(colon - text) : 0;
    if (colon && text[0] == '[' && length > 2 && text[length - 1] == ']') {
        text++;
        length -= 2;
    }
    if (colon && (!length || length >= sizeof host))
        return false;
    if (colon) {
        memcpy(host, text, length);
        host[length] = '\0';
    }
    errno = 0;
    const long number = strtol(port, &end, 10);
    if (*port < '0' || *port > '9' || *end || errno || number > 65535 || !host_read(host, out))
        return false;
    if (out->any.sa_family == AF_INET6)
        out->v6.sin6_port = htons((uint16_t)number);
    else
        out->v4.sin_port = htons((uint16_t)number);
    return true;
}

static enum stage_status wrong(const char *text)
{
    return stage_fail(STAGE_BAD_ARGUMENT,
                      "OSC: '%.60s' is no PORT and no ADDRESS:PORT (9000, 192.168.1.5:9000)",
                      text);
}

/* A socket that does not wait. */
static enum stage_status socket_make(const union address *a, const char *text, int *out)
{
    const int on = 1;
    *out = socket(a->any.sa_family, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (a->any.sa_family == AF_INET6 && *out >= 0) /* senders have addresses of one kind */
        setsockopt(*out, IPPROTO_IPV6, IPV6_V6ONLY, &on, sizeof on);
    return *out >= 0 ? STAGE_OK
                     : stage_fail(STAGE_FAILED, "OSC: %.60s: %s", text, strerror(errno));
}

static enum stage_status hear(struct osc_port *p, const struct osc_port_def *def)
{
    union address at;
    if (!address_read(def->listen, &at))
        return wrong(def->listen);
    if (def->from_count > OSC_FROM_MAX)
        return stage_fail(STAGE_BAD_ARGUMENT, "OSC: %d senders are the most", OSC_FROM_MAX);
    for (int i = 0; i < def->from_count; i++)
        if (!host_read(def->from[i], &p->from[p->from_count++]))
            return stage_fail(STAGE_BAD_ARGUMENT, "OSC: '%.60s' is no address (192.168.1.7)",
                              def->from[i]);
    if (!is_loopback(&at) && !def->from_count)
        return stage_fail(STAGE_BAD_ARGUMENT,
                          "OSC: %.60s is heard by a network: say by --osc-from ADDRESS whose "
                          "packets are taken, or take a PORT alone",
                          def->listen);
    enum stage_status status = socket_make(&at, def->listen, &p->heard);
    if (status == STAGE_OK && bind(p->heard, &at.any, bytes_of(&at)) != 0)
        status = stage_fail(STAGE_FAILED, "OSC: %.60s cannot be heard: %s", def->listen,
                            strerror(errno));
    return status;
}

enum stage_status osc_port_open(const struct osc_port_def *def, struct osc_port **out)
{
    struct osc_port *p = calloc(1, sizeof *p);
    union address to;
    *out = NULL;
    if (!p)
        return stage_fail(STAGE_NO_MEMORY, "no memory for OSC");
    p->heard = p->sent = -1;
    enum stage_status status = def->listen ? hear(p, def) : STAGE_OK;
    if (status == STAGE_OK && def->send) {
        status = address_read(def->send, &to) ? socket_make(&to, def->send, &p->sent)
                                              : wrong(def->send);
        if (status == STAGE_OK && connect(p->sent, &to.any, bytes_of(&to)) != 0)
            status = stage_fail(STAGE_FAILED, "OSC: nothing can be sent to %.60s: %s",
                                def->send, strerror(errno));
    }
    if (status == STAGE_OK)
        *out = p;
    else
        osc_port_close(p);
    return status;
}

void osc_port_close(struct osc_port *p)
{
    if (!p)
        return;
    if (p->heard >= 0)
        close(p->heard);
    if (p->sent >= 0)
        close(p->sent);
    free(p);
}

static bool is_heard(const struct osc_port *p, const union address *from)
{
    bool heard = is_loopback(from);
    for (int i = 0; i < p->from_count; i++)
        heard = heard || same_host(from, &p->from[i]);
    return heard;
}

size_t osc_port_next(struct osc_port *p, uint8_t *bytes, size_t room)
{
    enum { AT_ONCE = 1000 }; /* packets of others do not hold up a picture */
    for (int i = 0; i < AT_ONCE && p->heard >= 0; i++) {
        struct iovec part = {bytes, room};
        struct msghdr head = {.msg_name = &p->last,
                              .msg_namelen = sizeof p->last,
                              .msg_iov = &part,
                              .msg_iovlen = 1};
        const ssize_t count = recvmsg(p->heard, &head, 0);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return 0;
        p->last_bytes = head.msg_namelen;
        if (count > 0 && !(head.msg_flags & MSG_TRUNC) && is_heard(p, &p->last))
            return (size_t)count;
        p->dropped++;
    }
    return 0;
}

void osc_port_answer(struct osc_port *p, const uint8_t *bytes, size_t count)
{
    if (p->heard >= 0 && p->last_bytes && count)
        (void)!sendto(p->heard, bytes, count, MSG_NOSIGNAL, &p->last.any, p->last_bytes);
}

void osc_port_send(struct osc_port *p, const uint8_t *bytes, size_t count)
{
    if (p->sent >= 0 && count)
        (void)!send(p->sent, bytes, count, MSG_NOSIGNAL);
}

int osc_port_number(const struct osc_port *p)
{
    union address at = {0};
    socklen_t bytes = sizeof at;
    if (p->heard < 0 || getsockname(p->heard, &at.any, &bytes) != 0)
        return 0;
    return ntohs(at.any.sa_family == AF_INET6 ? at.v6.sin6_port : at.v4.sin_port);
}

long osc_port_dropped(const struct osc_port *p)
{
    return p->dropped;
}
