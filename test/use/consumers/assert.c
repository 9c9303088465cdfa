// SPDX-License-Identifier: MIT
// With FIXPID_ASSERT as assert: every function stops a caller one of whose
// pointers is wrong, and no other caller.
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

// Of assert.rb: the text of each call, and a null pointer at the end; and what
// makes one of them, with a wrong pointer or with a right one.
extern const char *const calls[];
void call(int number, bool wrong);

// How a process ends that makes this one call: its wait status.
static int outcome(int number, bool wrong)
{
    int status = -1;
    const pid_t child = fork();

    if (child == 0) {
        call(number, wrong);
        _exit(0);
    }
    if (child < 0 || waitpid(child, &status, 0) != child) {
        perror("assert");
        exit(1);
    }
    return status;
}

int main(void)
{
    int failed = 0;

    for (int number = 0; calls[number] != NULL; number++) {
        const int right = outcome(number, false);
        const int wrong = outcome(number, true);

        if (!WIFEXITED(right) || WEXITSTATUS(right) != 0) {
            printf("%s stops a caller that is right\n", calls[number]);
            failed++;
        }
        if (!WIFSIGNALED(wrong) || WTERMSIG(wrong) != SIGABRT) {
            printf("%s does not stop a caller that is wrong\n", calls[number]);
            failed++;
        }
    }
    return failed == 0 ? 0 : 1;
}
