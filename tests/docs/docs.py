# SPDX-License-Identifier: GPL-3.0-or-later
"""The pages of documentation: they build without a warning, links lead somewhere, nothing is fetched."""
import unittest


if __name__ == "__main__":
    unittest.main()
