// SPDX-License-Identifier: MIT
#include "fixpid_table.h"

#define VALID fixpid_table_valid
#define AT fixpid_table_at
#define READ(value) (value)
#include "fixpid_table_text.h"
