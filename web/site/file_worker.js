// SPDX-License-Identifier: MIT
// A browser runs no worker from a file: there, the search runs in a hidden frame.
// This and the index as a script are loaded from files only.
'use strict';

window.Worker = class extends EventTarget {
    constructor(url) {
        super();
        const frame = document.createElement('iframe');
        frame.hidden = true;
        frame.title = 'search';
        this.ready = new Promise((resolve) => {
            document.body.append(frame);
            this.inner = frame.contentWindow;
            const answer = (data) => {
                this.dispatchEvent(new MessageEvent('message', { data }));
            };
            this.inner.postMessage = answer;
            this.inner.importScripts = () => {}; // of other languages
            const script = frame.contentDocument.createElement('script');
            script.src = url;
            script.onload = resolve;
            frame.contentDocument.body.append(script);
        });
    }

    async postMessage(data) {
        await this.ready;
        this.inner.dispatchEvent(new MessageEvent('message', { data }));
    }
};
