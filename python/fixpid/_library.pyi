# SPDX-License-Identifier: MIT
# For type checkers: what cffi makes.
from typing import Any

ffi: Any
lib: Any
