# Completes command lines of lamp in fish, which asks lamp for the words.
# SPDX-License-Identifier: Apache-2.0
complete -c lamp -a '(lamp completion words -- (commandline -cp) 2>/dev/null)'
