error: cannot read `pr.toml`: there is no such file or folder
Command exited with non-zero status 2
0.00s
