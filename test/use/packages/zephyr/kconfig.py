# SPDX-License-Identifier: MIT
# The configuration of an application as Zephyr makes it: Kconfig of the module and
# prj.conf, read by kconfiglib, which is what Zephyr uses; a warning is an error.
#
#   python3 kconfig.py KCONFIG PRJ_CONF DOT_CONFIG
import sys

import kconfiglib

kconfig, prj_conf, dot_config = sys.argv[1:]
configuration = kconfiglib.Kconfig(kconfig, warn_to_stderr=False)
configuration.warn_assign_undef = True
configuration.load_config(prj_conf)
configuration.write_config(dot_config)
sys.exit("\n".join(configuration.warnings) or 0)
