/* The wall clock of a machine that is set again and again, by up to thirty years; with BEFORE_1970 in the environment it
   stands before 1970. For LD_PRELOAD. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <sys/time.h>
#include <time.h>

static atomic_uint readings;

static time_t jump(void) {
    static const time_t jumps[] = {0, 315360000, -900000000, 3600, -86400, 946080000};
    if (getenv("BEFORE_1970")) {
        return -2200000000;
    }
    return jumps[atomic_fetch_add(&readings, 1) % 6];
}

int clock_gettime(clockid_t clock, struct timespec *now) {
    int (*real)(clockid_t, struct timespec *) = dlsym(RTLD_NEXT, "clock_gettime");
    int code = real(clock, now);
    if (code == 0 && (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE)) {
        now->tv_sec += jump();
    }
    return code;
}

int gettimeofday(struct timeval *restrict now, void *restrict zone) {
    int (*real)(struct timeval *, void *) = dlsym(RTLD_NEXT, "gettimeofday");
    int code = real(now, zone);
    if (code == 0) {
        now->tv_sec += jump();
    }
    return code;
}

time_t time(time_t *now) {
    time_t (*real)(time_t *) = dlsym(RTLD_NEXT, "time");
    time_t value = real(NULL) + jump();
    if (now) {
        *now = value;
    }
    return value;
}
