// SPDX-License-Identifier: MIT
#include "fixpid_table.h"

#define READ(value) (value)
#include "fixpid_table_text.h"
