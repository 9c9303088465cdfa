// SPDX-License-Identifier: MIT
// The program around an application on the host: options, world, trace.
#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h> // Deviation 21.6: a program for a PC
#include <stdlib.h>
#include <string.h>

#include "host.h"
#include "port_board.h"
#include "world.h"

#define EXIT_WRONG_USE 2
#define NAME_MAX_LENGTH 32u

static const char *program;

struct request {
    const char *csv;
    double trace_period_s;
};

static void help(void)
{
    size_t count = 0;
    const struct world_option *const options = world_options(&count);

    (void)printf("usage: %s [option]...\n"
                 "Runs the application in its simulated world.\n\n"
                 "  --csv FILE        record a trace\n"
                 "  --every SECONDS   a row of the trace this often (default: "
                 "each tick)\n"
                 "  --seconds N       length of the scenario\n"
                 "  --seed N          seed of the sensors' noise (default: 1)\n"
                 "  --set NAME=VALUE  change the scenario:\n",
                 program);
    for (size_t i = 0; i < count; i++) {
        (void)printf("      %-14s %s (%g)\n", options[i].name,
                     options[i].meaning, options[i].value);
    }
}

static bool complain(const char *what, const char *which)
{
    (void)fprintf(stderr, "%s: %s: %s (see --help)\n", program, what, which);
    return false;
}

static bool number(const char *text, double *value)
{
    char *end = NULL;
    errno = 0;
    *value = strtod(text, &end);
    const bool in_range = (errno == 0);
    return in_range && (end != text) && (*end == '\0') &&
           (fabs(*value) <= DBL_MAX);
}

static bool set_option(const char *name, const char *text)
{
    double value = 0.0;
    if (!number(text, &value)) {
        return complain("not a number", text);
    }
    switch (world_set(name, value)) {
    case WORLD_OK:
        return true;
    case WORLD_OUT_OF_RANGE:
        return complain("out of range", name);
    default:
        return complain("no such number in this scenario", name);
    }
}

static bool set_assignment(const char *text)
{
    char name[NAME_MAX_LENGTH] = {0};
    const size_t length = strcspn(text, "=");
    if (text[length] == '\0') {
        return complain("not NAME=VALUE", text);
    }
    if (length >= sizeof(name)) {
        return complain("no such number in this scenario", text);
    }
    (void)memcpy(name, text, length);
    return set_option(name, &text[length + 1u]);
}

static bool set_seed(const char *text)
{
    double value = 0.0;
    if (!number(text, &value) || (value < 0.0) ||
        (value > (double)UINT32_MAX) || (value != floor(value))) {
        return complain("not a seed (0..4294967295)", text);
    }
    host_seed((uint32_t)value);
    return true;
}

static bool set_period(const char *text, double *period_s)
{
    if (!number(text, period_s) || (*period_s < 1e-6)) {
        return complain("not a period in seconds", text);
    }
    return true;
}

static bool take(struct request *request, const char *option, const char *value)
{
    bool good = false;
    if (strcmp(option, "--csv") == 0) {
        request->csv = value;
        good = true;
    } else if (strcmp(option, "--every") == 0) {
        good = set_period(value, &request->trace_period_s);
    } else if (strcmp(option, "--seconds") == 0) {
        good = set_option("seconds", value);
    } else if (strcmp(option, "--seed") == 0) {
        good = set_seed(value);
    } else if (strcmp(option, "--set") == 0) {
        good = set_assignment(value);
    } else {
        good = complain("no such option", option);
    }
    return good;
}

static bool parse(struct request *request, int count, char **arguments)
{
    bool good = true;
    for (int i = 1; good && (i < count); i += 2) {
        good = ((i + 1) < count)
                   ? take(request, arguments[i], arguments[i + 1])
                   : complain("unknown option, or no value", arguments[i]);
    }
    return good;
}

static int run(const struct request *request)
{
    if ((request->csv != NULL) &&
        !host_trace_open(request->csv, request->trace_period_s)) {
        (void)fprintf(stderr, "%s: cannot write %s: %s\n", program,
                      request->csv, strerror(errno));
        return EXIT_FAILURE;
    }
    int status = application_main();
    host_report();
    if (!host_trace_close()) {
        (void)fprintf(stderr, "%s: could not write all of %s\n", program,
                      request->csv);
        status = EXIT_FAILURE;
    }
    return status;
}

int main(int argc, char **argv)
{
    struct request request = {NULL, 1.0 / (double)PORT_TICKS_PER_SECOND};
    program = (argc > 0) ? argv[0] : "host";
    if ((argc > 1) && (strcmp(argv[1], "--help") == 0)) {
        help();
        return EXIT_SUCCESS;
    }
    return parse(&request, argc, argv) ? run(&request) : EXIT_WRONG_USE;
}
