"""install.py FOLDER WHERE - copies a folder that the build made into the installation, links as links."""
import os
import pathlib
import shutil
import sys

source, where = pathlib.Path(sys.argv[1]), pathlib.Path(os.environ["MESON_INSTALL_DESTDIR_PREFIX"]) / sys.argv[2]
for path in sorted(source.rglob("*")):
    to = where / path.relative_to(source)
    if path.is_symlink() or path.is_file():
        to.parent.mkdir(parents=True, exist_ok=True)
        to.unlink(missing_ok=True)
        shutil.copy2(path, to, follow_symlinks=False)
        if not path.is_symlink():
            to.chmod(0o644)
