// SPDX-License-Identifier: MIT
// The questions of test/chips/target/cases.c and the answers to them, as files
// of bytes in the order of a chip:
//
//   questions CONTROLLER little|big STEPS QUESTIONS ANSWERS
//
// Every recorded row, then random steps. Prints
//
//   rows 2000 steps 1000 question 10 answer 10 object 20
//
// what was written, and bytes of one of each and of the controller's object.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "vectors.h"

// The sizes of the members, in their order.
static const struct layout {
    const char *name;
    const char *question;
    const char *answer;
} layouts[CONTROLLERS] = {
    {"an937", "22111111", "444441111"},
    {"an964", "222211", "222211"},
    {"an964_8bit", "11111", "222211"},
    {"pid", "4222222222222211112", "44422112"},
};

static const struct controller *controller;
static const struct layout *layout;
static bool big_endian;
static FILE *questions, *answers;
static union question question;
static union answer answer;

static void die(const char *why)
{
    (void)fprintf(stderr, "questions: %s\n", why);
    exit(2);
}

static unsigned size_of(const char *members)
{
    unsigned size = 0;

    for (; *members != '\0'; members++) {
        size += (unsigned)(*members - '0');
    }
    return size;
}

static void put(FILE *file, const void *value, const char *members)
{
    const uint8_t *member = value;

    for (; *members != '\0'; members++) {
        const unsigned size = (unsigned)(*members - '0');

        for (unsigned at = 0; at < size; at++) {
            (void)fputc(member[big_endian ? size - 1u - at : at], file);
        }
        member += size;
    }
}

static void put_both(void)
{
    put(questions, &question, layout->question);
    put(answers, &answer, layout->answer);
}

static unsigned put_rows(void)
{
    int32_t columns[VECTORS_COLUMNS_MAX];
    unsigned rows = 0;

    for (const struct recording *from = controller->recordings;
         from->name != NULL; from++) {
        const unsigned before = rows;

        cases_begin(1);
        vectors_open(from->name);
        while (vectors_next(columns)) {
            from->row(columns, &question, &answer);
            put_both();
            rows++;
        }
        if (rows - before != from->rows) {
            die("a recording has not its rows");
        }
    }
    return rows;
}

static void put_steps(unsigned steps)
{
    cases_begin(1);
    for (unsigned step = 0; step < steps; step++) {
        controller->ask(&question);
        controller->define(&question, &answer);
        put_both();
    }
}

int main(int argc, char *argv[])
{
    unsigned rows;
    unsigned steps;

    if (argc != 6) {
        die("wrong use");
    }
    controller = controller_named(argv[1]);
    if (controller == NULL) {
        die("no such controller");
    }
    layout = &layouts[controller - controllers];
    if (strcmp(layout->name, controller->name) != 0 ||
        size_of(layout->question) != controller->question_size ||
        size_of(layout->answer) != controller->answer_size) {
        die("exchange.h has other members");
    }
    big_endian = strcmp(argv[2], "big") == 0;
    steps = (unsigned)strtoul(argv[3], NULL, 10);
    questions = fopen(argv[4], "wb");
    answers = fopen(argv[5], "wb");
    if (questions == NULL || answers == NULL) {
        die("cannot write");
    }
    rows = put_rows();
    put_steps(steps);
    if (fclose(questions) != 0 || fclose(answers) != 0) {
        die("cannot write");
    }
    (void)printf("rows %u steps %u question %u answer %u object %u\n", rows,
                 steps, controller->question_size, controller->answer_size,
                 controller->object_size);
    return 0;
}
