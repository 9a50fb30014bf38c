#!/usr/bin/env bash
# Builds, tests and packages the extension: behaviortree.vsix. It needs Node.js 20 and npm, Chromium, and `btc` itself,
# which cargo has built or `BTC` names.
set -euo pipefail
cd "$(dirname "$0")"

npm ci --ignore-scripts --no-audit --no-fund --loglevel=error
cp ../../LICENSE-MIT ../../LICENSE-APACHE .
npm run --silent package
npm run --silent test
