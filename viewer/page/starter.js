// Unpacks the program and runs it. It lies in the page as gzip, like the run: a third of its size.
(async () => {
  const fail = (words) => {
    const box = document.getElementById('failure');
    box.textContent = words;
    box.className = 'failure';
    box.hidden = false;
  };
  if (typeof DecompressionStream === 'undefined')
    return fail('This browser cannot unpack the page: it has no DecompressionStream. Chromium 80, Firefox 113 and Safari 16.4 have it, and later ones.');
  try {
    const letters = atob(document.getElementById('program').textContent);
    const bytes = Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
    const text = await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'))).text();
    const script = document.createElement('script');
    script.textContent = text;
    document.body.append(script);
    await window.muster_started;
  } catch (error) {
    fail(`The page cannot be shown: ${error.message}`);
    throw error;
  }
})();
