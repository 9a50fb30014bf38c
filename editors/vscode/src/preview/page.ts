// The page of the preview. Nothing is loaded from outside, and no script runs but the extension's own.

export interface Resources {
  script: string;
  style: string;
  /** Where the editor serves the extension's files from. */
  source: string;
  nonce: string;
}

export function page({ script, style, source, nonce }: Resources): string {
  const policy = `default-src 'none'; style-src ${source} 'unsafe-inline'; script-src 'nonce-${nonce}'`;
  return `<!DOCTYPE html>
<html lang="en">
<head>
  <meta charset="UTF-8">
  <meta http-equiv="Content-Security-Policy" content="${policy}">
  <meta name="viewport" content="width=device-width, initial-scale=1">
  <link rel="stylesheet" href="${style}">
  <title>Tree</title>
</head>
<body>
  <header>
    <select id="trees" aria-label="Tree"></select>
    <label title="Show the tree under the cursor"><input type="checkbox" id="follow"> follow the cursor</label>
    <span class="space"></span>
    <button id="out" title="Smaller" aria-label="Smaller">−</button>
    <button id="fit" title="As large as the panel">fit</button>
    <button id="in" title="Larger" aria-label="Larger">+</button>
    <button id="save" title="Save the picture as SVG">save</button>
  </header>
  <p id="problem" role="status" hidden></p>
  <main id="picture"></main>
  <script nonce="${nonce}" src="${script}"></script>
</body>
</html>
`;
}
